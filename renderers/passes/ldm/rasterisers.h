#pragma once

#include "renderers/graph/pass_context.h"
#include "renderers/passes/ldm/builder.h"

namespace ir::passes::ldm {

/// For fragments that tell points their faces (Maps::finds_faces): constants of faces.glsl.
struct FaceTarget {
    unsigned face_texel = 0, face_stride = 1;
    IR_FIELDS(face_texel, face_stride)
};

/// Raster builder: draws triangles first … end - 1 into all maps of a chunk at once. `first_map` counts among
/// all frames.
void draw_triangles(const graph::PassContext& context, const SceneBuffers& scene, const Maps& maps,
                    const Chunk& chunk, int first_map, std::int64_t first, std::int64_t end,
                    const FaceTarget& faces = {});

/// Compute builder: the same in a compute shader; large triangles are only listed.
void dispatch_triangles(const graph::PassContext& context, const Maps& maps, const Chunk& chunk,
                        int first_map, std::int64_t first, std::int64_t end, const FaceTarget& faces = {});

/// Rasterises the listed large triangles of a chunk.
void dispatch_large_triangles(const graph::PassContext& context, const Maps& maps, const Chunk& chunk,
                              int first_map, const FaceTarget& faces = {});

}  // namespace ir::passes::ldm
