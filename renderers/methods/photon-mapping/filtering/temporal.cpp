#include <optional>

#include "renderers/methods/photon-mapping/filtering/stages.h"
#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "renderers/passes/scene/stands_still.h"

namespace ir::methods::photon_mapping {
namespace {

struct TemporalInputs {
    passes::GBuffer gbuffer;
    graph::ImageRef surfaces;
    Splat splat;
    passes::a_trous::Signal history;
    std::optional<graph::ImageRef> length;  ///< "history.length", where frames before this one count
    Parameters parameters;
};

/// Accesses of filtering/unfiltered.glsl and, where history counts, filtering/history.glsl.
void declare_reads(graph::PassBuilder& pass, const TemporalInputs& in) {
    pass.reads("splat_irradiance", in.splat.irradiance)
        .reads("splat_direction", in.splat.direction)
        .reads("surfaces", in.surfaces);
    if (!in.length) return;
    pass.reads_previous("previous_value", in.history.value)
        .reads_previous("previous_direction", *in.history.direction)
        .reads_previous("previous_length", *in.length);
    if (in.parameters.is_progressive()) return;
    pass.reads(in.gbuffer.velocity, in.gbuffer.geometric_normal)
        .reads_previous("previous_surfaces", in.surfaces);
}

/// Constants of temporal.comp and history_view.comp.
struct Temporal {
    passes::a_trous::Edges edges;
    float temporal_weight;
    bool has_history, warms_up, stands_still;
    glm::vec3 previous_origin_dx, previous_origin_dy;
    glm::vec3 previous_direction_ws, previous_direction_dx, previous_direction_dy;
    IR_FIELDS(edges, temporal_weight, has_history, warms_up, stands_still, previous_origin_dx,
              previous_origin_dy, previous_direction_ws, previous_direction_dx, previous_direction_dy)
};

Temporal temporal(const graph::PassContext& context, const Parameters& parameters) {
    const auto previous = passes::pixel_rays(context.inputs().previous_view);
    return {.edges = passes::a_trous::edges(context.inputs(), filter_options(parameters)),
            .temporal_weight = parameters.temporal_weight,
            .has_history = context.has_previous(),
            .warms_up = parameters.warm_up,
            .stands_still = passes::stands_still(context.inputs(), passes::Watched::surfaces_and_lights),
            .previous_origin_dx = previous.origin_dx,
            .previous_origin_dy = previous.origin_dy,
            .previous_direction_ws = previous.direction,
            .previous_direction_dx = previous.direction_dx,
            .previous_direction_dy = previous.direction_dy};
}

bool rejects_ghosts(const Parameters& parameters) {
    return parameters.temporal && parameters.reject_ghosts && !parameters.is_progressive();
}

void average(graph::PassBuilder& pass, const graph::GraphBuilder& builder, const TemporalInputs& in,
             gl::ProgramSource source) {
    source.defines["DIVISOR"] = std::to_string(in.splat.divisor);
    source.defines["PIXEL_OF_TEXEL"] = std::to_string(pixel_of_texel(in.splat.divisor));
    if (in.length) source.defines["HISTORY"] = "1";
    if (in.parameters.is_progressive()) source.defines["PROGRESSIVE"] = "1";
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
    TemporalInputs in{gbuffer, surfaces, splat, result, {}, parameters};
    if (parameters.temporal) in.length = builder.output("history.length", {.format = gl::Format::r32f});
    const auto overflow =
        builder.counter({.key = "splat.overflow",
                         .label = "Texels beyond half floats",
                         .doc = "Pixels whose sum of kernels grew beyond what half floats hold; they stay at "
                                "65,504, or 0 where the direction is lost. Choose single floats."});
    auto pass = builder.pass("temporal filter");
    declare_reads(pass, in);
    pass.counts("Overflow", overflow);
    pass.writes("value_image", result.value).writes("direction_image", *result.direction);
    if (in.length) pass.writes("length_image", *in.length);
    gl::ProgramSource source{{folder + "temporal.comp"}};
    if (parameters.has_half_sums()) source.defines["HALF_SUMS"] = "1";
    if (rejects_ghosts(parameters)) source.defines["REJECTS_GHOSTS"] = "1";
    average(pass, builder, in, source);
    if (!in.length) return result;
    show(builder, in, "history.weight", true);
    show(builder, in, "history.ghosting", false);
    return result;
}

}  // namespace ir::methods::photon_mapping
