#include "renderers/methods/ldm-indirect/parameters.h"

#include "renderers/passes/scene/progressive.h"

namespace ir::methods::ldm_indirect {
namespace {

void add_frames(ParameterTable<Parameters>& table) {
    table
        .add(
            &Parameters::progressive,
            {.key = "progressive",
             .label = "Progressive",
             .doc = "Turns the set of directions at random in every frame, moves photons, shrinks footprints "
                    "and averages over frames: noise and blur go to 0 together. Without it frames are "
                    "equal.",
             .citation = "Aalund15 §6"})
        .add(&Parameters::radius_decay,
             {.key = "radius_decay",
              .label = "Decay of radii",
              .doc = "α: squared axes of footprints shrink by (k + α)/(k + 1) after the k-th frame. Variance "
                     "falls with frames^-α, and where surfaces are large the blur with frames^(α-1). "
                     "At 1 they keep their size.",
              .citation = "Knaus11 eq. 18",
              .hard = {0.01, 1},
              .soft = {0.3, 1},
              .active_when = {"progressive", {true}}});
}

}  // namespace

std::optional<passes::Tracer> ray_tracer(const Parameters& parameters) {
    switch (parameters.tracer) {
        case Tracer::directions:
            break;
        case Tracer::cube:
            return passes::Tracer::cube;
        case Tracer::compute:
            return passes::Tracer::compute;
        case Tracer::embree:
            return passes::Tracer::embree;
    }
    return {};
}

bool traces_on_host(const Parameters& parameters) {
    return parameters.tracer != Tracer::compute && parameters.splatting != Splatting::one_pass;
}

std::uint64_t photon_seed(const graph::FrameInputs& inputs, const Parameters& parameters) {
    return parameters.progressive ? passes::frame_seed(inputs) : inputs.seed;
}

Parameters of_frame(const Parameters& parameters, const graph::FrameInputs& inputs) {
    Parameters result = parameters;
    if (!parameters.progressive) return result;
    result.maps.rotation = passes::ldm::random_rotation(inputs.seed, inputs.frame);
    result.splat_size *=
        passes::progressive_shrinking(passes::frames_standing(inputs), parameters.radius_decay);
    return result;
}

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    table.include(&Parameters::maps, passes::ldm::map_parameters());
    table.include(
        &Parameters::transport,
        transport_parameters({.paths = {"direct", "indirect", "full"},
                              .keys = {"max_bounces", "materials", "normal_maps", "environment_light"}}));
    add_frames(table);
    add_tracing_parameters(table);
    add_splatting_parameters(table);
    table.include(&Parameters::gloss, gloss_parameters());
    table.include(&Parameters::receivers, passes::receiver_parameters(4, {"gloss", {std::string("none")}}));
    table.include(&Parameters::light, passes::light_parameters());
    table.include(&Parameters::maps, passes::ldm::self_hit_parameters());
    return table;
}

}  // namespace ir::methods::ldm_indirect
