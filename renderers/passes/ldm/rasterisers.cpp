#include "renderers/passes/ldm/rasterisers.h"

#include <functional>

namespace ir::passes::ldm {
namespace {

gl::ProgramSource source_for(const Maps& maps, std::vector<std::string> files, bool masked) {
    gl::ProgramSource source{std::move(files)};
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

/// Calls `run(first, end, masked)` for the opaque and for the masked part of a range of triangles.
void for_both_kinds(const graph::PassContext& context, std::int64_t first, std::int64_t end,
                    const std::function<void(std::int64_t, std::int64_t, bool)>& run) {
    const std::int64_t opaque = context.inputs().world->opaque_triangles;
    if (first < opaque) run(first, std::min(end, opaque), false);
    if (end > opaque) run(std::max(first, opaque), end, true);
}

void set_faces(const gl::Program& program, const FaceTarget* faces) {
    if (!faces) return;
    program.set("face_texel", faces->first_texel);
    program.set("face_stride", faces->stride);
}

/// Hands u, v and depth of the frames of a chunk's maps to a compute rasteriser.
void set_frame_rows(const gl::Program& program, const Maps& maps, int first_map, int count) {
    std::vector<glm::vec4> rows;
    for (int map = first_map; map < first_map + count; ++map) {
        const auto& frame = maps.frames[static_cast<std::size_t>(map)];
        rows.insert(rows.end(), {frame.u, frame.v, frame.depth});
    }
    program.set("frame_rows", rows);
}

}  // namespace

void draw_triangles(const graph::PassContext& context, const SceneBuffers& scene, const Maps& maps,
                    const Chunk& chunk, int first_map, std::int64_t first, std::int64_t end,
                    const FaceTarget* faces) {
    const auto& gl = context.api();
    context.bind_empty_framebuffer(maps.layout.resolution, maps.layout.resolution);
    context.bind_empty_vertex_array();
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, context.buffer(scene.indices));
    for_both_kinds(context, first, end, [&](std::int64_t begin, std::int64_t stop, bool masked) {
        auto source = source_for(maps, {"passes/ldm/rasterise.vert", "passes/ldm/rasterise.frag"}, masked);
        if (maps.inserts_directly()) source.defines["DIRECT"] = "1";
        const auto& program = context.use(source);
        program.set("first_map", static_cast<unsigned>(first_map));
        program.set("first_instance", 0u);
        program.set("first_triangle", static_cast<unsigned>(begin));
        program.set("resolution", maps.layout.resolution);
        set_faces(program, faces);
        if (maps.inserts_directly())
            program.set("batch_texel", static_cast<unsigned>(chunk.first_map * maps.layout.map_texels()));
        gl.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(3 * (stop - begin)), GL_UNSIGNED_INT,
                                 reinterpret_cast<const void*>(begin * 12), chunk.maps);
    });
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
}

void dispatch_triangles(const graph::PassContext& context, const Maps& maps, const Chunk& chunk,
                        int first_map, std::int64_t first, std::int64_t end, const FaceTarget* faces) {
    for_both_kinds(context, first, end, [&](std::int64_t begin, std::int64_t stop, bool masked) {
        const auto& program = context.use(source_for(maps, {"passes/ldm/rasterise.comp"}, masked));
        program.set("map_count", static_cast<unsigned>(chunk.maps));
        set_frame_rows(program, maps, first_map, chunk.maps);
        program.set("resolution", maps.layout.resolution);
        set_faces(program, faces);
        constexpr std::int64_t most = 1 << 21;  // invocations of one dispatch
        for (std::int64_t at = begin; at < stop; at += most) {
            const auto last = std::min(stop, at + most);
            program.set("first_triangle", static_cast<unsigned>(at));
            program.set("end_triangle", static_cast<unsigned>(last));
            program.dispatch(last - at);
        }
    });
}

void dispatch_large_triangles(const graph::PassContext& context, const Maps& maps, const Chunk& chunk,
                              int first_map, const FaceTarget* faces) {
    const auto& world = *context.inputs().world;
    for (const bool masked : {false, true}) {
        if (masked && world.opaque_triangles == world.triangles()) continue;
        const auto& program = context.use(source_for(maps, {"passes/ldm/rasterise_large.comp"}, masked));
        set_frame_rows(program, maps, first_map, chunk.maps);
        program.set("resolution", maps.layout.resolution);
        set_faces(program, faces);
        program.set("opaque_triangles", world.opaque_triangles);
        dispatch_indirect(context, maps.list.state, large_groups_word);
    }
}

}  // namespace ir::passes::ldm
