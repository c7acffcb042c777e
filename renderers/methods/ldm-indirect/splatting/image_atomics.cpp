#include <algorithm>

#include "renderers/gl/dispatch_items.h"
#include "renderers/methods/ldm-indirect/splatting/stored.h"
#include "shaders/methods/ldm-indirect/splatting/atomic_splat.comp.h"

namespace ir::methods::ldm_indirect {
namespace {

constexpr std::int64_t lanes = splat_lanes;
constexpr std::int64_t groups_at_once = 32768;
constexpr std::int64_t pixels_at_once = 60000 * lanes;  ///< llvmpipe ends loops after 65,535 turns

/// Constants of atomic_splat.comp.
struct SplatAtomically {
    Outlines outlines;
    unsigned first_pixel, end_pixel;
    gl::Items items;
    IR_FIELDS(outlines, first_pixel, end_pixel, items)
};

void splat_atomically(const graph::PassContext& p, graph::Slice slice, const SplatTask& task,
                      graph::ImageRef sums) {
    if (slice.first) p.clear(sums);
    gl::ProgramSource source{{folder + "atomic_splat.comp"}};
    define_clipped(source, task.photons);
    add_by_atomics(p, source, sums);
    const auto& program = p.use(source);
    set_units(p, program, task.photons);
    const auto& view = p.inputs().view;
    const auto pixels = std::int64_t{view.width} * view.height;
    const auto outlined = outlines(p.inputs(), task.photons);
    const auto range = passes::photons_of(p, task.photons, slice);
    for (std::int64_t pixel = 0; pixel < pixels; pixel += pixels_at_once) {
        for (auto first = range.first; first < range.end; first += groups_at_once) {
            const auto end = std::min(range.end, first + groups_at_once);
            program.set(SplatAtomically{.outlines = outlined,
                                        .first_pixel = static_cast<unsigned>(pixel),
                                        .end_pixel = static_cast<unsigned>(pixel + pixels_at_once),
                                        .items = {static_cast<unsigned>(first), static_cast<unsigned>(end)}});
            program.dispatch((end - first) * lanes);
        }
    }
}

}  // namespace

graph::ImageRef declare_sums(graph::GraphBuilder& builder) {
    graph::ImageDesc desc;
    desc.text = {.key = "splat.sums",
                 .label = "Sums of atomic additions",
                 .doc = "Bits of floats. Layers: R, G, B, W/m², photons, and the sum of directions."};
    desc.format = gl::Format::r32ui;
    desc.layers = 7;
    return builder.image(desc);
}

void add_by_atomics(const graph::PassContext& p, gl::ProgramSource& source, graph::ImageRef sums) {
    if (p.api().NV_shader_atomic_float == 0) return;
    source.preamble = "#extension GL_NV_shader_atomic_float : require\n";
    source.defines["FLOAT_ATOMICS"] = "1";
    p.bind("sums", sums, gl::Format::r32f);
}

void show_sums(graph::GraphBuilder& builder, const SplatTask& task, graph::ImageRef sums) {
    builder.pass("atomic sums")
        .reads("sums", sums)
        .writes("irradiance", task.irradiance)
        .writes("directions", task.direction)
        .compute({{folder + "atomic_sums.comp"}}, task.irradiance);
}

void splat_image_atomics(graph::GraphBuilder& builder, const SplatTask& task) {
    const auto sums = declare_sums(builder);
    auto pass = builder.pass("splat photons atomically");
    reads_task(pass, task);
    reads_looks(pass, task.photons);
    pass.writes("sums", sums)
        .execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            splat_atomically(p, slice, task, sums);
        });
    show_sums(builder, task, sums);
}

}  // namespace ir::methods::ldm_indirect
