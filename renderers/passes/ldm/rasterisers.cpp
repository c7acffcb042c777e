#include "renderers/passes/ldm/rasterisers.h"

#include <array>
#include <functional>

#include "renderers/gl/dispatch_items.h"

namespace ir::passes::ldm {
namespace {

gl::ProgramSource source_for(const Maps& maps, std::vector<std::string> files, bool masked) {
    gl::ProgramSource source{std::move(files)};
    if (!maps.finds_faces()) source.defines = node_defines(maps.layout);
    if (masked) source.defines["MASKED"] = "1";
    if (maps.finds_faces()) {
        source.defines["LDM_FACES"] = "1";
        if (maps.storage->depth_bits() < 16)
            source.defines["LDM_PACKED_BITS"] = std::to_string(maps.storage->depth_bits());
    } else if (maps.storage->needs_arrivals()) {
        source.defines["LDM_ARRIVALS"] = "1";
    }
    return source;
}

/// Calls `run(first, end, masked)` for the opaque and for the masked part of a range of triangles, and once
/// where there is none: a pass uses its programs in every frame, which is how its declarations are checked.
void for_both_kinds(const graph::PassContext& context, std::int64_t first, std::int64_t end,
                    const std::function<void(std::int64_t, std::int64_t, bool)>& run) {
    const std::int64_t opaque = context.inputs().world->opaque_triangles;
    if (first < opaque || first == end) run(first, std::min(end, opaque), false);
    if (end > opaque) run(std::max(first, opaque), end, true);
}

/// Constants of triangle_rows.glsl.
struct TriangleRows {
    std::array<glm::vec4, 3 * 32> frame_rows;
    IR_FIELDS(frame_rows)
};

/// u, v and depth of the frames of a chunk's maps.
TriangleRows triangle_rows(const Maps& maps, int first_map, int count) {
    TriangleRows rows{};
    auto row = rows.frame_rows.begin();
    for (int map = first_map; map < first_map + count; ++map) {
        const auto& frame = maps.frames[static_cast<std::size_t>(map)];
        for (const auto& value : {frame.u, frame.v, frame.depth}) *row++ = value;
    }
    return rows;
}

/// Constants of rasterise.vert and rasterise.frag.
struct DrawTriangles {
    unsigned first_map, first_triangle, batch_texel;
    int resolution;
    FaceTarget faces;
    IR_FIELDS(first_map, first_triangle, batch_texel, resolution, faces)
};

/// Constants of rasterise.comp.
struct Rasterise {
    TriangleRows rows;
    unsigned map_count;
    int resolution;
    FaceTarget faces;
    IR_FIELDS(rows, map_count, resolution, faces)
};

/// Constants of prepare.comp with PREPARE_LARGE.
struct PrepareLarge {
    unsigned large_capacity;
    IR_FIELDS(large_capacity)
};

/// Constants of rasterise_large.comp.
struct RasteriseLarge {
    TriangleRows rows;
    int resolution;
    unsigned opaque_triangles;
    FaceTarget faces;
    IR_FIELDS(rows, resolution, opaque_triangles, faces)
};

}  // namespace

void draw_triangles(const graph::PassContext& context, const SceneBuffers& scene, const Maps& maps,
                    const Chunk& chunk, int first_map, std::int64_t first, std::int64_t end,
                    const FaceTarget& faces) {
    const auto& gl = context.api();
    context.bind_empty_framebuffer(maps.layout.resolution, maps.layout.resolution);
    context.bind_empty_vertex_array();
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, context.buffer(scene.indices));
    for_both_kinds(context, first, end, [&](std::int64_t begin, std::int64_t stop, bool masked) {
        auto source = source_for(maps, {"passes/ldm/rasterise.vert", "passes/ldm/rasterise.frag"}, masked);
        if (maps.inserts_directly()) source.defines["DIRECT"] = "1";
        const auto& program = context.use(source);
        program.set(
            DrawTriangles{.first_map = static_cast<unsigned>(first_map),
                          .first_triangle = static_cast<unsigned>(begin),
                          .batch_texel = static_cast<unsigned>(chunk.first_map * maps.layout.map_texels()),
                          .resolution = maps.layout.resolution,
                          .faces = faces});
        gl.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(3 * (stop - begin)), GL_UNSIGNED_INT,
                                 reinterpret_cast<const void*>(begin * 12), chunk.maps);
    });
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
}

void dispatch_triangles(const graph::PassContext& context, const Maps& maps, const Chunk& chunk,
                        int first_map, std::int64_t first, std::int64_t end, const FaceTarget& faces) {
    for_both_kinds(context, first, end, [&](std::int64_t begin, std::int64_t stop, bool masked) {
        const auto& program = context.use(source_for(maps, {"passes/ldm/rasterise.comp"}, masked));
        program.set(Rasterise{.rows = triangle_rows(maps, first_map, chunk.maps),
                              .map_count = static_cast<unsigned>(chunk.maps),
                              .resolution = maps.layout.resolution,
                              .faces = faces});
        gl::dispatch_items(program, begin, stop);
    });
}

void dispatch_large_triangles(const graph::PassContext& context, const Maps& maps, const Chunk& chunk,
                              int first_map, const FaceTarget& faces) {
    const auto& prepare = context.use({{"passes/ldm/prepare.comp"}, {{"PREPARE_LARGE", "1"}}});
    prepare.set(PrepareLarge{static_cast<unsigned>(context.capacity(maps.large))});
    prepare.dispatch(1);
    context.barrier();
    const auto& world = *context.inputs().world;
    for (const bool masked : {false, true}) {
        if (masked && world.opaque_triangles == world.triangles()) continue;
        const auto& program = context.use(source_for(maps, {"passes/ldm/rasterise_large.comp"}, masked));
        program.set(RasteriseLarge{.rows = triangle_rows(maps, first_map, chunk.maps),
                                   .resolution = maps.layout.resolution,
                                   .opaque_triangles = world.opaque_triangles,
                                   .faces = faces});
        dispatch_indirect(context, maps.list.state, large_groups_word);
    }
}

}  // namespace ir::passes::ldm
