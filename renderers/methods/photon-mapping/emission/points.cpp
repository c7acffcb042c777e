#include "renderers/methods/photon-mapping/emission/points.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/error.h"
#include "renderers/core/record.h"
#include "renderers/passes/scan/scan.h"
#include "shaders/methods/photon-mapping/records.glsl.h"

namespace ir::methods::photon_mapping {
namespace {

using graph::FieldType;
using graph::PassContext;

graph::BufferRef words(graph::GraphBuilder& builder, graph::ResourceText text, const std::string& field,
                       std::uint64_t elements) {
    return builder.buffer({.text = std::move(text),
                           .fields = {{field, FieldType::u32}},
                           .elements = std::max<std::uint64_t>(1, elements)});
}

/// Constants of budget.comp.
struct DividePoints {
    int levels;  ///< of the maps
    unsigned points, source_count;
    IR_FIELDS(levels, points, source_count)
};

void divide(const PassContext& p, const Sources& sources, const EmissionPoints& points,
            const EmissionMaps* maps) {
    p.upload(points.samples.sources, std::as_bytes(std::span(sources.elements)));
    p.barrier();
    gl::ProgramSource source{{"methods/photon-mapping/emission/budget.comp"},
                             {{"BY_PROBABILITY", maps ? "1" : "0"}}};
    const auto& program = p.use(source);
    program.set(DividePoints{maps ? maps->levels : 0, static_cast<unsigned>(points.count),
                             static_cast<unsigned>(sources.elements.size())});
    program.dispatch(1);
}

/// Constants of points.comp.
struct WarpPoints {
    SurfaceRules rules;
    EmissionSets sets;
    IR_FIELDS(rules, sets)
};

/// Constants of samples.comp.
struct PackPoints {
    WarpPoints warped;
    unsigned capacity;
    float power_unit, photons_per_point;
    IR_FIELDS(warped, capacity, power_unit, photons_per_point)
};

/// Of both steps over the points of an RSM.
gl::ProgramSource source_over_maps(const char* file, const Parameters& parameters) {
    gl::ProgramSource source{{file}};
    const bool warps = parameters.emission == Emission::importance;
    source.defines["WARPS"] = warps ? "1" : "0";
    source.defines["PRINTED_POWER"] = warps && parameters.power_scaling == PowerScaling::printed ? "1" : "0";
    return source;
}

}  // namespace

EmissionPoints declare_points(graph::GraphBuilder& builder, const Sources& sources,
                              const Parameters& parameters) {
    EmissionPoints points;
    const auto asked =
        static_cast<std::uint64_t>(std::max(1, parameters.photons / parameters.photons_per_point));
    if (sources.flux > 0) points.count = asked;
    auto& samples = points.samples;
    samples.photons_per_point = parameters.photons_per_point;
    samples.paths = points.count * static_cast<std::uint64_t>(parameters.photons_per_point);
    if (samples.paths > 0) samples.power_unit = sources.flux / static_cast<float>(samples.paths);
    const double reserved = std::ceil(static_cast<double>(parameters.reserve) * static_cast<double>(asked));
    samples.points = builder.output(
        "photons.samples", {.fields = record_fields<SamplePoint>(),
                            .elements = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(reserved)),
                            .growable = true});
    samples.count = builder.counter({.key = "photons.sample_count",
                                     .label = "Sample points",
                                     .doc = "Points of the emission sets that survive.",
                                     .growth_of = samples.points});
    samples.sources =
        builder.output("photons.sources", {.fields = record_fields<SourceData>(),
                                           .elements = std::max<std::uint64_t>(1, sources.elements.size())});
    points.candidates = words(builder,
                              {.key = "emission.candidates",
                               .label = "Emission points",
                               .doc = "For each point of the emission sets where it came to: bits 0-9 texel "
                                      "x, 10-19 texel y, 20-25 source, 26 set where it survives."},
                              "place", points.count);
    points.survivors = words(builder,
                             {.key = "emission.survivors",
                              .label = "Surviving points",
                              .doc = "1 for each point of the emission sets that survives the roulette."},
                             "survives", points.count);
    return points;
}

void divide_points(graph::GraphBuilder& builder, const Sources& sources, const EmissionPoints& points,
                   const EmissionMaps* maps, const Parameters& parameters) {
    const auto without = builder.counter({.key = "emission.sources_without_points",
                                          .label = "Lights without photons",
                                          .doc = "Maps of lights that shine, but whose share is less than "
                                                 "half a photon: their light is missing."});
    const bool by_probability = maps && parameters.budget == Budget::probability;
    auto pass = builder.pass("photon budget");
    if (by_probability) pass.reads("haar_pyramid", maps->haar);
    pass.writes("Sources", points.samples.sources).counts("WithoutPoints", without);
    const auto used = by_probability ? std::optional(*maps) : std::nullopt;
    pass.execute([=](PassContext& p) { divide(p, sources, points, used ? &*used : nullptr); });
}

void find_places(graph::GraphBuilder& builder, EmissionPoints& points) {
    points.places = passes::exclusive_scan(builder, "emission.survivors", points.survivors, points.count,
                                           points.samples.count);
}

void find_points(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Sources& sources,
                 const passes::Rsm& rsm, const EmissionMaps& maps, EmissionPoints& points,
                 const Parameters& parameters) {
    const auto reads = [&](graph::PassBuilder& pass) {
        passes::reads_rsm(pass, rsm, scene);
        pass.reads("probability_map", maps.probability)
            .reads("haar_pyramid", maps.haar)
            .reads("Sources", points.samples.sources);
    };
    const auto items = static_cast<std::int64_t>(points.count);
    const WarpPoints warped{surface_rules(parameters),
                            emission_sets(builder.inputs(), sources, points, parameters)};
    auto warp = builder.pass("emission points");
    reads(warp);
    warp.writes("Candidates", points.candidates).writes("Survivors", points.survivors);
    warp.compute_sliced(source_over_maps("methods/photon-mapping/emission/points.comp", parameters), items,
                        warped, first_points_slice);
    find_places(builder, points);
    auto pack = builder.pass("sample points");
    reads(pack);
    pack.reads("Candidates", points.candidates)
        .reads("Places", points.places)
        .writes("Samples", points.samples.points);
    pack.compute_sliced(
        source_over_maps("methods/photon-mapping/emission/samples.comp", parameters), items,
        [=, samples = points.samples](const PassContext& p) {
            return PackPoints{warped, static_cast<unsigned>(p.capacity(samples.points)), samples.power_unit,
                              static_cast<float>(samples.photons_per_point)};
        },
        first_points_slice);
}

EmissionSets emission_sets(const graph::FrameInputs& inputs, const Sources& sources,
                           const EmissionPoints& points, const Parameters& parameters) {
    const auto strata = static_cast<unsigned>(parameters.strata);
    return {.source_count = static_cast<unsigned>(sources.elements.size()),
            .all_points = static_cast<unsigned>(points.count),
            .strata = strata,
            .stratum = static_cast<unsigned>(inputs.frame) % strata,
            .seed_low = static_cast<unsigned>(inputs.seed),
            .seed_high = static_cast<unsigned>(inputs.seed >> 32)};
}

std::vector<OutputDescription> point_outputs() {
    return {{.key = "photons.samples",
             .label = "Sample points",
             .kind = OutputKind::point_set,
             .semantic = Semantic::position,
             .unit = "m",
             .doc = "Where photons leave: points that survived the roulette at the first surface, in the "
                    "order of their seeds. power: RGB9E5; normal: octahedral; surface: base colour and "
                    "roughness; origin: texel x and y, layer, metalness; see records.h."},
            {.key = "photons.sources",
             .label = "Sources of photons",
             .kind = OutputKind::table,
             .doc = "One element per layer of the RSM, or per light whose rays are traced: its place, "
                    "direction, light, intensity, flux (W, mean of the channels), and which points of the "
                    "emission set it has."}};
}

}  // namespace ir::methods::photon_mapping
