#pragma once

#include <cstddef>
#include <optional>

#include "renderers/core/transport.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::passes {

/// What is visible at the centre of each pixel; in shaders gbuffer_position, gbuffer_normal, …. Normals are
/// unit length and turned to the viewer; background pixels are 0. Glass is left out: its pixels hold what
/// lies behind it along the straight view ray.
struct GBuffer {
    graph::ImageRef depth;     ///< "gbuffer.depth" depth32f, 0…1, background 1
    graph::ImageRef position;  ///< "gbuffer.position" rgba32f: xyz world space (m); w distance to the eye (m)
    graph::ImageRef normal;  ///< "gbuffer.normal" rgba16f: xyz shading normal, with normal maps if asked for
    graph::ImageRef geometric_normal;  ///< "gbuffer.geometric_normal" rgba32f: xyz of the triangle's plane; w
                                       ///< where the point was along the previous view's axis, m
    graph::ImageRef albedo;            ///< "gbuffer.albedo" rgba16f: linear base colour; a: transmission
    graph::ImageRef
        material;  ///< "gbuffer.material" rgba16f: x metallic, y roughness, z unlit, w material index
    graph::ImageRef emission;  ///< "gbuffer.emission" rgba16f: radiance
    graph::ImageRef
        velocity;  ///< "gbuffer.velocity" rg16f: pixels from the previous frame's place to this one's
    graph::ImageRef valid;  ///< "valid" r8: 1 where the result counts; background and glass are 0
    /// "gbuffer.glass" rgba32f: rgb the part of the light that the glass before the surface lets straight
    /// through; a how many of its surfaces there are. Only where a material may be glass that is left out.
    std::optional<graph::ImageRef> glass = {};
};

/// For methods that list them among their outputs.
OutputDescription position_output();
OutputDescription normal_output();
OutputDescription albedo_output();
OutputDescription valid_output();

/// Scenes with more materials have pixels whose half float names another material than theirs.
inline constexpr std::size_t gbuffer_materials = 2048;

struct GBufferOptions {
    bool normal_maps = true;
    bool sees_through_glass = true;  ///< else glass is a surface like any other, though not valid
};
/// As the transport says; where all materials are opaque, glass is.
GBufferOptions gbuffer_options(const Transport& transport);

/// Declares the pass "G-buffer", drawn or on the host, and, where a material may be glass, "glass".
GBuffer gbuffer(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBufferOptions& options = {});

/// Of images (rg32ui) that hold what filters compare of a pixel's surface.
inline constexpr const char* packed_surface_doc =
    "Geometric normal, octahedral in 2 x 16 bits, and the bits of the depth along the view axis (m); infinite "
    "where there is no surface";

}  // namespace ir::passes
