#pragma once

#include <vector>

#include "renderers/graph/builder.h"

namespace ir::passes {

/// The world on the device, uploaded once per world. Buffers mirror scene::World
/// (shaders/passes/scene/scene.glsl declares them); vectors are tightly packed floats (12 bytes for a vec3).
struct SceneBuffers {
    graph::BufferRef positions, normals, tangents, uv0, uv1, colours, indices, triangle_materials;
    graph::BufferRef to_previous;  ///< of each vertex, or one zero for all
    graph::BufferRef materials;    ///< see shaders/lib/material.glsl
    graph::BufferRef lights;       ///< see shaders/lib/light.glsl
    graph::BufferRef opacity;      ///< scene::OpacityBitmap of each material (width 0: opaque)
    graph::BufferRef opacity_words;
    std::vector<graph::ImageRef> textures;  ///< with mip levels; as many as Scene::textures
};

/// Declares the passes "upload scene", "upload lights" and, for scenes with textures, "upload textures", and
/// their resources
/// ("scene.positions", …, "scene.texture.N").
SceneBuffers upload_scene(graph::GraphBuilder& builder);

}  // namespace ir::passes
