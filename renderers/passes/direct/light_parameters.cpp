#include "renderers/passes/direct/light_parameters.h"

#include <cstdint>
#include <utility>

namespace ir::passes {

ParameterTable<LightParameters> light_parameters() {
    ParameterTable<LightParameters> table;
    table
        .add(&LightParameters::light_samples,
             {.key = "light_samples",
              .label = "Light samples",
              .doc = "Direct light of rectangles, disks, emissive meshes and the environment: samples per "
                     "pixel and frame, each with a ray towards a source and one along a reflected direction. "
                     "While nothing moves, frames are averaged. 0 leaves these sources out.",
              .citation = "Veach95",
              .hard = {0, 4096},
              .soft = {0, 64},
              .coarse = std::int64_t{4}})
        .add(&LightParameters::light_filter,
             {.key = "light_filter",
              .label = "Filter of sampled light",
              .doc = "Takes the noise of the light samples away, by an edge-avoiding filter that lets pixels "
                     "differ as far as their variance does not explain. Light of few samples becomes a "
                     "little too dark; this and the blur vanish as frames add up.",
              .citation = "Schied17 §4.3"})
        .add(&LightParameters::light_filter_strength,
             {.key = "light_filter_strength",
              .label = "Strength of that filter",
              .doc = "σ_l: neighbours whose luminance is so many standard errors away count 1/e.",
              .citation = "Schied17 eq. 5",
              .hard = {0.01, 1000},
              .soft = {0.5, 8},
              .active_when = {"light_filter", {true}}});
    return table;
}

MissingLight without_light_samples(std::vector<LightPart> parts, std::vector<LightKind> kinds) {
    return {std::move(parts), std::move(kinds), {{"light_samples", {std::int64_t{0}}}}};
}

}  // namespace ir::passes
