#include "renderers/methods/photon-mapping/filtering/stages.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

namespace ir::methods::photon_mapping {
namespace {

struct TemporalInputs {
    passes::GBuffer gbuffer;
    graph::ImageRef surfaces;
    Splat splat;
    Signal history;
    Parameters parameters;
};

/// Accesses of filtering/unfiltered.glsl and, where history counts, filtering/history.glsl.
void declare_reads(graph::PassBuilder& pass, const TemporalInputs& in) {
    pass.reads(in.splat.irradiance, in.splat.direction, in.surfaces);
    if (in.splat.divisor > 1) pass.reads(in.splat.depth);
    if (!in.parameters.temporal) return;
    pass.reads(in.gbuffer.velocity, in.gbuffer.geometric_normal)
        .reads_previous(in.history.value, in.history.direction, in.surfaces);
}

void set_previous_rays(const gl::Program& program, const scene::View& view) {
    const auto rays = passes::pixel_rays(view);
    program.set("previous_origin_dx", rays.origin_dx);
    program.set("previous_origin_dy", rays.origin_dy);
    program.set("previous_direction_ws", rays.direction);
    program.set("previous_direction_dx", rays.direction_dx);
    program.set("previous_direction_dy", rays.direction_dy);
}

void bind_history(const graph::PassContext& context, const gl::Program& program, const TemporalInputs& in) {
    context.bind_texture(4, in.gbuffer.velocity);
    context.bind_texture(5, in.gbuffer.geometric_normal);
    context.bind_previous_texture(6, in.history.value);
    context.bind_previous_texture(7, in.history.direction);
    context.bind_previous_texture(8, in.surfaces);
    program.set("temporal_weight", in.parameters.temporal_weight);
    program.set("has_history", context.has_previous() ? 1 : 0);
    set_previous_rays(program, context.inputs().previous_view);
}

const gl::Program& use(const graph::PassContext& context, const TemporalInputs& in,
                       gl::ProgramSource source) {
    source.defines["DIVISOR"] = std::to_string(in.splat.divisor);
    if (in.parameters.temporal) source.defines["HISTORY"] = "1";
    const auto& program = context.program(source);
    program.use();
    set_edges(context, program, in.parameters);
    context.bind_texture(0, in.splat.irradiance);
    context.bind_texture(1, in.splat.direction);
    context.bind_texture(2, in.surfaces);
    if (in.splat.divisor > 1) context.bind_texture(3, in.splat.depth);
    if (in.parameters.temporal) bind_history(context, program, in);
    return program;
}

void show(graph::GraphBuilder& builder, const TemporalInputs& in, graph::ResourceText text, bool is_weight) {
    graph::ImageDesc desc;
    desc.text = std::move(text);
    desc.format = gl::Format::r32f;
    const auto view = builder.image(desc);
    auto pass = builder.pass(desc.text.label);
    declare_reads(pass, in);
    pass.writes(view);
    execute_by_rows(pass, group_rows(builder), [=](graph::PassContext& context, graph::Slice slice) {
        gl::ProgramSource source{{folder + "history_view.comp"}};
        if (is_weight) source.defines["VIEW_WEIGHT"] = "1";
        const auto& program = use(context, in, source);
        context.bind_storage_image(0, view);
        dispatch_rows(context, program, slice);
    });
}

}  // namespace

Signal accumulate(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ImageRef surfaces,
                  const Splat& splat, const Parameters& parameters) {
    const auto result = declare_signal(builder, "filter.temporal", "After the temporal filter",
                                       "The estimate at the view's resolution, averaged over frames.");
    const TemporalInputs in{gbuffer, surfaces, splat, result, parameters};
    const auto overflow =
        builder.counter({.key = "splat.overflow",
                         .label = "Texels beyond half floats",
                         .doc = "Pixels whose sum of kernels grew beyond what half floats hold; they stay at "
                                "65,504, or 0 where the direction is lost. Choose single floats."});
    auto pass = builder.pass("temporal filter");
    declare_reads(pass, in);
    pass.counts(overflow);
    pass.writes(result.value, result.direction);
    execute_by_rows(pass, group_rows(builder), [=](graph::PassContext& context, graph::Slice slice) {
        gl::ProgramSource source{{folder + "temporal.comp"}};
        if (in.parameters.sum_precision == Precision::half_float) source.defines["HALF_SUMS"] = "1";
        const auto& program = use(context, in, source);
        context.bind_storage_image(0, result.value);
        context.bind_storage_image(1, result.direction);
        context.bind_counter(0, overflow);
        dispatch_rows(context, program, slice);
    });
    if (!parameters.temporal) return result;
    show(builder, in, {"history.weight", "Weight of history", "α; 0: rejected"}, true);
    show(builder, in, {"history.ghosting", "Ghosting", "Part of a pixel that the present does not explain"},
         false);
    return result;
}

}  // namespace ir::methods::photon_mapping
