#pragma once

#include "renderers/graph/pass_context.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::passes {

/// What shaders/passes/scene/hit_surface.glsl needs to look up the surface that a ray hit.
struct HitSurfaces {
    graph::BufferRef vertices;  ///< "scene.hit_vertices": all of a vertex in 64 bytes, as hits are all over
    graph::BufferRef texels;    ///< texel_buffer
    graph::BufferRef indices, triangle_materials, materials;  ///< the scene's

    void read_by(graph::PassBuilder& pass) const {
        pass.reads(vertices, texels).reads("HitIndices", indices);
        read_materials_by(pass);
    }
    /// Only what hit_materials.glsl needs.
    void read_materials_by(graph::PassBuilder& pass) const {
        pass.reads("HitTriangleMaterials", triangle_materials).reads("HitMaterials", materials);
    }
};

/// Declares "scene.hit_vertices" and "scene.texels" with the passes that upload them, once per
/// world; or gives what the builder has already.
HitSurfaces hit_surfaces(graph::GraphBuilder& builder, const SceneBuffers& scene);

}  // namespace ir::passes
