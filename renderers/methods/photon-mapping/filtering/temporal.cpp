#include "renderers/methods/photon-mapping/filtering/stages.h"

namespace ir::methods::photon_mapping {
namespace {

struct TemporalInputs {
    passes::GBuffer gbuffer;
    graph::ImageRef surfaces;
    Splat splat;
    passes::a_trous::Signal history;
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
        .reads_previous("previous_direction", *in.history.direction)
        .reads_previous("previous_surfaces", in.surfaces);
}

/// Constants of temporal.comp and history_view.comp.
struct Temporal {
    passes::a_trous::Edges edges;
    float temporal_weight;
    bool has_history;
    glm::vec3 previous_origin_dx, previous_origin_dy;
    glm::vec3 previous_direction_ws, previous_direction_dx, previous_direction_dy;
    IR_FIELDS(edges, temporal_weight, has_history, previous_origin_dx, previous_origin_dy,
              previous_direction_ws, previous_direction_dx, previous_direction_dy)
};

Temporal temporal(const graph::PassContext& context, const Parameters& parameters) {
    const auto previous = passes::pixel_rays(context.inputs().previous_view);
    return {.edges = passes::a_trous::edges(context.inputs(), filter_options(parameters)),
            .temporal_weight = parameters.temporal_weight,
            .has_history = context.has_previous(),
            .previous_origin_dx = previous.origin_dx,
            .previous_origin_dy = previous.origin_dy,
            .previous_direction_ws = previous.direction,
            .previous_direction_dx = previous.direction_dx,
            .previous_direction_dy = previous.direction_dy};
}

void average(graph::PassBuilder& pass, const graph::GraphBuilder& builder, const TemporalInputs& in,
             gl::ProgramSource source) {
    source.defines["DIVISOR"] = std::to_string(in.splat.divisor);
    if (in.parameters.temporal) source.defines["HISTORY"] = "1";
    compute_by_rows(pass, builder, source, [parameters = in.parameters](const graph::PassContext& context) {
        return temporal(context, parameters);
    });
}

void show(graph::GraphBuilder& builder, const TemporalInputs& in, const std::string& key, bool is_weight) {
    const auto view = builder.output(key, {.format = gl::Format::r32f});
    auto pass = builder.pass(builder.text_of_output(key).label);
    declare_reads(pass, in);
    pass.writes("view", view);
    gl::ProgramSource source{{folder + "history_view.comp"}};
    if (is_weight) source.defines["VIEW_WEIGHT"] = "1";
    average(pass, builder, in, source);
}

}  // namespace

passes::a_trous::Signal accumulate(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                                   graph::ImageRef surfaces, const Splat& splat,
                                   const Parameters& parameters) {
    const auto result =
        passes::a_trous::declare_signal(builder, builder.text_of_output("filter.temporal"), true);
    const TemporalInputs in{gbuffer, surfaces, splat, result, parameters};
    const auto overflow =
        builder.counter({.key = "splat.overflow",
                         .label = "Texels beyond half floats",
                         .doc = "Pixels whose sum of kernels grew beyond what half floats hold; they stay at "
                                "65,504, or 0 where the direction is lost. Choose single floats."});
    auto pass = builder.pass("temporal filter");
    declare_reads(pass, in);
    pass.counts("Overflow", overflow);
    pass.writes("value_image", result.value).writes("direction_image", *result.direction);
    gl::ProgramSource source{{folder + "temporal.comp"}};
    if (parameters.sum_precision == Precision::half_float) source.defines["HALF_SUMS"] = "1";
    average(pass, builder, in, source);
    if (!parameters.temporal) return result;
    show(builder, in, "history.weight", true);
    show(builder, in, "history.ghosting", false);
    return result;
}

}  // namespace ir::methods::photon_mapping
