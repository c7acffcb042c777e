#include "renderers/gl/dispatch_items.h"
#include "renderers/methods/ldm-indirect/splatting/stored.h"

namespace ir::methods::ldm_indirect {
namespace {

using graph::FieldType;

graph::BufferRef declare_command(graph::GraphBuilder& builder) {
    graph::BufferDesc desc;
    desc.text = {
        .key = "splat.command", .label = "Command of the draw", .doc = "Points of the last slice drawn."};
    desc.fields = {{"points", FieldType::u32},
                   {"instances", FieldType::u32},
                   {"first_point", FieldType::u32},
                   {"base_instance", FieldType::u32}};
    desc.elements = 1;
    return builder.buffer(desc);
}

void write_command(const graph::PassContext& p, passes::PhotonRange range) {
    const auto& program = p.use({{folder + "draw.comp"}});
    program.set(gl::Items{static_cast<unsigned>(range.first), static_cast<unsigned>(range.end)});
    program.dispatch(1);
    p.barrier();
}

void splat_quads(const graph::PassContext& p, graph::Slice slice, const SplatTask& task,
                 graph::BufferRef command) {
    if (slice.first) p.clear(task.irradiance);
    if (slice.first) p.clear(task.direction);
    const auto range = passes::photons_of(p, task.photons, slice);
    if (range.first == range.end) return;
    write_command(p, range);
    p.bind_framebuffer({{task.irradiance}, {task.direction}});
    gl::ProgramSource source{{folder + "quads.vert", folder + "quads.geom", folder + "quads.frag"}};
    define_clipped(source, task.photons);
    const auto& program = p.use(source);
    program.set(outlines(p.inputs(), task.photons));
    set_units(p, program, task.photons);
    p.bind_empty_vertex_array();
    const auto& gl = p.api();
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, GL_ONE);
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, p.buffer(command));
    gl.DrawArraysIndirect(GL_POINTS, nullptr);
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    gl.Disable(GL_BLEND);
}

}  // namespace

void splat_quads(graph::GraphBuilder& builder, const SplatTask& task) {
    const auto command = declare_command(builder);
    auto pass = builder.pass("splat photons");
    reads_task(pass, task);
    reads_looks(pass, task.photons);
    pass.writes("Draw", command).writes(task.irradiance, task.direction);
    pass.execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
        splat_quads(p, slice, task, command);
    });
}

}  // namespace ir::methods::ldm_indirect
