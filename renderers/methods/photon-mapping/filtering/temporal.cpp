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
    pass.reads("splat_irradiance", in.splat.irradiance)
        .reads("splat_direction", in.splat.direction)
        .reads("surfaces", in.surfaces);
    if (in.splat.divisor > 1) pass.reads("splat_depth", in.splat.depth);
    if (!in.parameters.temporal) return;
    pass.reads(in.gbuffer.velocity, in.gbuffer.geometric_normal)
        .reads_previous("previous_value", in.history.value)
        .reads_previous("previous_direction", in.history.direction)
        .reads_previous("previous_surfaces", in.surfaces);
}

void set_previous_rays(const gl::Program& program, const scene::View& view) {
    const auto rays = passes::pixel_rays(view);
    program.set("previous_origin_dx", rays.origin_dx);
    program.set("previous_origin_dy", rays.origin_dy);
    program.set("previous_direction_ws", rays.direction);
    program.set("previous_direction_dx", rays.direction_dx);
    program.set("previous_direction_dy", rays.direction_dy);
}

void set_history(const graph::PassContext& context, const gl::Program& program, const TemporalInputs& in) {
    program.set("temporal_weight", in.parameters.temporal_weight);
    program.set("has_history", context.has_previous() ? 1 : 0);
    set_previous_rays(program, context.inputs().previous_view);
}

const gl::Program& use(const graph::PassContext& context, const TemporalInputs& in,
                       gl::ProgramSource source) {
    source.defines["DIVISOR"] = std::to_string(in.splat.divisor);
    if (in.parameters.temporal) source.defines["HISTORY"] = "1";
    const auto& program = context.use(source);
    set_edges(context, program, in.parameters);
    if (in.parameters.temporal) set_history(context, program, in);
    return program;
}

void show(graph::GraphBuilder& builder, const TemporalInputs& in, const std::string& key, bool is_weight) {
    const auto view = builder.output(key, {.format = gl::Format::r32f});
    auto pass = builder.pass(builder.text_of_output(key).label);
    declare_reads(pass, in);
    pass.writes("view", view);
    execute_by_rows(pass, group_rows(builder), [=](graph::PassContext& context, graph::Slice slice) {
        gl::ProgramSource source{{folder + "history_view.comp"}};
        if (is_weight) source.defines["VIEW_WEIGHT"] = "1";
        const auto& program = use(context, in, source);
        dispatch_rows(context, program, slice);
    });
}

}  // namespace

Signal accumulate(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ImageRef surfaces,
                  const Splat& splat, const Parameters& parameters) {
    const auto result = declare_signal(builder, builder.text_of_output("filter.temporal"));
    const TemporalInputs in{gbuffer, surfaces, splat, result, parameters};
    const auto overflow =
        builder.counter({.key = "splat.overflow",
                         .label = "Texels beyond half floats",
                         .doc = "Pixels whose sum of kernels grew beyond what half floats hold; they stay at "
                                "65,504, or 0 where the direction is lost. Choose single floats."});
    auto pass = builder.pass("temporal filter");
    declare_reads(pass, in);
    pass.counts("Overflow", overflow);
    pass.writes("value_image", result.value).writes("direction_image", result.direction);
    execute_by_rows(pass, group_rows(builder), [=](graph::PassContext& context, graph::Slice slice) {
        gl::ProgramSource source{{folder + "temporal.comp"}};
        if (in.parameters.sum_precision == Precision::half_float) source.defines["HALF_SUMS"] = "1";
        const auto& program = use(context, in, source);
        dispatch_rows(context, program, slice);
    });
    if (!parameters.temporal) return result;
    show(builder, in, "history.weight", true);
    show(builder, in, "history.ghosting", false);
    return result;
}

}  // namespace ir::methods::photon_mapping
