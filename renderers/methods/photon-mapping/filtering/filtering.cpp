#include "renderers/methods/photon-mapping/stages.h"

#include "renderers/methods/photon-mapping/filtering/stages.h"
#include "renderers/passes/direct/direct_light.h"

namespace ir::methods::photon_mapping {
namespace {

constexpr std::int64_t max_passes = 6;

Condition at_least(std::int64_t passes) {
    Condition condition{"filter_passes", {}};
    for (auto i = passes; i <= max_passes; ++i) condition.values.emplace_back(i);
    return condition;
}

const Condition while_temporal{"temporal", {true}};

OutputDescription level_view(std::string key, std::string label, std::string doc, Condition active_when) {
    return {.key = std::move(key),
            .label = std::move(label),
            .kind = OutputKind::stack,
            .semantic = Semantic::irradiance,
            .unit = "W/m²",
            .doc = std::move(doc),
            .active_when = std::move(active_when)};
}

std::vector<OutputDescription> results() {
    return {
        {.key = "radiance",
         .label = "Radiance",
         .semantic = Semantic::radiance,
         .unit = "W/(m² sr)",
         .doc = "What leaves towards the eye. How indirect light is reflected is up to “Receivers”. Pixels "
                "without a surface are 0, or with the paths “full” a constant environment."},
        {.key = "irradiance",
         .label = "Irradiance",
         .semantic = Semantic::irradiance,
         .unit = "W/m²",
         .doc = "Indirect light on the surface as it is shaded: filtered, and with the directional term "
                "where that is on. With the receivers “full” without what the interface reflects."}};
}

std::vector<OutputDescription> temporal_views() {
    return {
        {.key = "filter.temporal",
         .label = "After the temporal filter",
         .semantic = Semantic::irradiance,
         .unit = "W/m²",
         .doc = "The estimate at the view's resolution, averaged over frames. The fourth channel is the "
                "x component of the sum of directions to the light; with the receivers “full” red of what "
                "the interface reflects."},
        {.key = "history.weight",
         .label = "Weight of history",
         .semantic = Semantic::probability,
         .doc = "α: how much of the pixel comes from earlier frames. 0: what was there is another "
                "surface, or was not in the picture.",
         .active_when = while_temporal},
        {.key = "history.length",
         .label = "Frames in the history",
         .semantic = Semantic::count,
         .doc = "Of how many frames the pixel is the mean, this one included; less where an earlier surface "
                "fits only in part. 0: no surface.",
         .active_when = while_temporal},
        {.key = "history.ghosting",
         .label = "Ghosting",
         .semantic = Semantic::probability,
         .doc = "Fraction of the pixel that comes from earlier frames and that this frame's estimate around "
                "it does not explain: α max(0, |S - μ| - σ) / max(S, μ) with history S and the mean μ "
                "and deviation σ of the estimate on the same surface, up to eight pixels away. It is "
                "what clipping to the neighbourhood's variance would take away [Salvi16].",
         .active_when = while_temporal},
        {.key = "history.flicker",
         .label = "Spread of directions",
         .semantic = Semantic::probability,
         .doc = "1 minus the length of the mean direction to the light. Where it is large, the mean "
                "stands for light from several sides, and what depends on it flickers [Smal19 fig. 8.7].",
         .active_when = {"receiver",
                         {std::string("diffuse"), std::string("mean-direction"), std::string("widened")}}}};
}

std::vector<OutputDescription> spatial_views() {
    return {level_view("filter.scaling", "Scaling coefficients",
                       "S_0, which the spatial filter starts from, to S_N, by pass. The fourth channel is x "
                       "of the sum of directions.",
                       {}),
            level_view("filter.detail", "Details", "D_i = S_i - S_{i+1}, by pass.", at_least(1)),
            level_view("filter.clipped", "Clipped details",
                       "Details within their bounds, which are added to S_N again.", at_least(1)),
            level_view("filter.bound", "Bounds of details",
                       "CSB_i: γ times the standard deviation under the filter's kernel.", at_least(1))};
}

}  // namespace

passes::ArrivedLight filter_irradiance(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                                       const Splat& splat, const Parameters& parameters) {
    if (parameters.is_progressive() && parameters.filter_passes > 0)
        builder.note("the spatial filter blurs a picture that converges; set filter_passes=0");
    const auto surfaces = passes::a_trous::pack_surfaces(builder, gbuffer);
    const auto averaged = accumulate(builder, gbuffer, surfaces, splat, parameters);
    const auto filtered = smooth(builder, surfaces, averaged, parameters);
    return {filtered.value, *filtered.direction};
}

std::vector<OutputDescription> filtering_outputs() {
    return joined({results(), passes::direct_outputs(), temporal_views(), spatial_views()});
}

std::vector<Stage> filtering_stages() {
    std::vector<Stage> stages{{"splat.irradiance", 0, "Unfiltered", {}},
                              {"filter.temporal", 0, "Temporal filter", {}}};
    for (std::int64_t i = 1; i <= max_passes; ++i)
        stages.push_back({"filter.scaling", static_cast<int>(i), "Spatial filter, pass " + std::to_string(i),
                          at_least(i)});
    stages.push_back({"irradiance", 0, "Final", {}});
    return stages;
}

}  // namespace ir::methods::photon_mapping
