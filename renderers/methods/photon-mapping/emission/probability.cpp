#include "renderers/methods/photon-mapping/emission/probability.h"

#include <bit>
#include <sstream>

#include "renderers/methods/photon-mapping/emission/weights.h"
#include "renderers/methods/photon-mapping/specular.h"

namespace ir::methods::photon_mapping {
namespace {

using graph::PassContext;

/// Below this many texels a side all further levels are made in shared memory.
constexpr int small_size = 32;
constexpr int small_levels = 5;  ///< 2^5 = small_size

/// Constants of probability.comp.
struct Probabilities {
    SurfaceRules rules;
    int first_layer, layers_drawn;
    IR_FIELDS(rules, first_layer, layers_drawn)
};

void find_probabilities(const PassContext& p, const passes::Rsm& rsm, const Parameters& parameters,
                        graph::Slice slice) {
    const auto& program = p.use({{"methods/photon-mapping/emission/probability.comp"}});
    program.set(Probabilities{surface_rules(*p.inputs().scene, parameters), static_cast<int>(slice.begin),
                              rsm.views_drawn});
    program.dispatch(rsm.resolution, rsm.resolution, slice.end - slice.begin);
}

/// Constants of haar.comp.
struct Haar {
    int level_below, size;
    IR_FIELDS(level_below, size)
};

/// Level 0 comes from the map, each other one from the level below.
void make_large_levels(const PassContext& p, const EmissionMaps& maps) {
    for (int level = 0; maps.resolution >> level > small_size; ++level) {
        p.bind("below", level == 0 ? maps.probability : maps.haar);
        p.bind("level", maps.haar, level);
        const auto& program = p.use({{"methods/photon-mapping/emission/haar.comp"}});
        const int size = maps.resolution >> (level + 1);
        program.set(Haar{std::max(0, level - 1), size});
        program.dispatch(size, size, maps.layers);
        p.barrier();
    }
}

/// Constants of haar_small.comp.
struct SmallHaar {
    int level_below, size_below;
    IR_FIELDS(level_below, size_below)
};

void make_small_levels(const PassContext& p, const EmissionMaps& maps) {
    const int first = std::max(0, maps.levels - small_levels);
    p.bind("below", first == 0 ? maps.probability : maps.haar);
    for (int i = 0; i < small_levels; ++i)
        p.bind("level" + std::to_string(i), maps.haar, std::min(first + i, maps.levels - 1));
    const auto& program = p.use({{"methods/photon-mapping/emission/haar_small.comp"}});
    program.set(SmallHaar{std::max(0, first - 1), maps.resolution >> first});
    const auto group = program.work_group_size();
    program.dispatch(group.x, group.y, maps.layers);
}

}  // namespace

EmissionMaps haar_pyramid(graph::GraphBuilder& builder, graph::ImageRef map, int resolution, int layers,
                          const std::string& fingerprint) {
    EmissionMaps maps;
    maps.probability = map;
    maps.resolution = resolution;
    maps.levels = std::bit_width(static_cast<unsigned>(resolution)) - 1;
    maps.layers = layers;
    maps.haar =
        builder.output("emission.haar", {.format = gl::Format::rgba32f,
                                         .extent = graph::Extent::fixed(resolution / 2, resolution / 2),
                                         .levels = maps.levels,
                                         .layers = layers,
                                         .fingerprint = fingerprint});
    if (resolution > small_size)
        builder.pass("Haar pyramid").reads(map).writes(maps.haar).execute([=](PassContext& p) {
            make_large_levels(p, maps);
        });
    builder.pass("Haar pyramid, last levels").reads(map).writes(maps.haar).execute([=](PassContext& p) {
        make_small_levels(p, maps);
    });
    return maps;
}

EmissionMaps emission_maps(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                           const passes::Rsm& rsm, const std::optional<TexelWeights>& weights,
                           const Parameters& parameters) {
    std::ostringstream fingerprint;
    fingerprint.precision(9);
    if (!rsm.fingerprint.empty())
        fingerprint << rsm.fingerprint << " model " << static_cast<int>(parameters.transport.materials)
                    << " from " << parameters.photon_near << " to " << parameters.photon_far;
    const auto map = builder.output("emission.probability",
                                    {.format = gl::Format::r32f,
                                     .extent = graph::Extent::fixed(rsm.resolution, rsm.resolution),
                                     .layers = rsm.layers,
                                     .fingerprint = fingerprint.str()});
    auto pass = builder.pass("emission probability");
    reads_map(pass, rsm, scene);
    pass.writes("probability", map)
        .execute_sliced(
            rsm.layers,
            [=](PassContext& p, graph::Slice slice) { find_probabilities(p, rsm, parameters, slice); }, 1);
    if (!weights) return haar_pyramid(builder, map, rsm.resolution, rsm.layers, fingerprint.str());
    return haar_pyramid(builder, weigh(builder, map, *weights, parameters), rsm.resolution, rsm.layers, "");
}

void reads_map(graph::PassBuilder& pass, const passes::Rsm& rsm, const passes::SceneBuffers& scene) {
    passes::reads_rsm(pass, rsm, scene);
    pass.reads(rsm.geometric_normal);
}

SurfaceRules surface_rules(const scene::Scene& scene, const Parameters& parameters) {
    const auto model = parameters.transport.materials;
    return {static_cast<int>(model), max_specular_events(scene, model) > 0, parameters.photon_near,
            parameters.photon_far};
}

std::vector<OutputDescription> probability_outputs() {
    return {
        {.key = "emission.probability",
         .label = "Emission probability",
         .kind = OutputKind::stack,
         .semantic = Semantic::probability,
         .doc = "Probability that a photon survives its first surface, times the light's fall-off and the "
                "texel's extent relative to the map's middle; 0 outside the photon planes and where "
                "nothing is. Not normalised. Lights without a map, whose rays are traced, have none.",
         .active_when = from_rsm()},
        {.key = "emission.haar",
         .label = "Haar pyramid",
         .kind = OutputKind::pyramid,
         .doc = "Haar transform of the emission probability. Each texel stands for a quad of the level "
                "below (of the map, at level 0): r the mean; g left minus right, b upper minus lower, "
                "a the diagonals, each a quarter of the difference. The last level is the map's mean.",
         .active_when = from_rsm()}};
}

}  // namespace ir::methods::photon_mapping
