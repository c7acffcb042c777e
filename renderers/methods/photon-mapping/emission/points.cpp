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
    unsigned points, source_count, traced_count;
    IR_FIELDS(levels, points, source_count, traced_count)
};

void divide(const PassContext& p, const Sources& sources, const EmissionPoints& points,
            const EmissionMaps* maps) {
    p.upload(points.samples.sources, std::as_bytes(std::span(sources.layers)));
    p.barrier();
    gl::ProgramSource source{
        {"methods/photon-mapping/emission/budget.comp"},
        {{"BY_PROBABILITY", maps ? "1" : "0"}, {"TRACED", sources.has_traced() ? "1" : "0"}}};
    const auto& program = p.use(source);
    program.set(DividePoints{maps ? maps->levels : 0, static_cast<unsigned>(points.from_maps),
                             static_cast<unsigned>(sources.layers.size()),
                             static_cast<unsigned>(sources.traced_rows.size())});
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

/// Packed powers reach from 2⁻¹⁵ to 2¹⁶ units with all digits: so much above the unit is the environment, of
/// which fewer rays start than its power would have, at most.
constexpr float largest_power = 1024;

/// In proportion to the flux, and at least one where there is any.
std::uint64_t points_from_maps(const Sources& sources, std::uint64_t points) {
    if (!sources.has_traced() || points == 0) return points;
    if (!(sources.layer_flux > 0)) return 0;
    const double share = double(sources.layer_flux) / double(sources.flux());
    const auto part = static_cast<std::uint64_t>(std::llround(share * static_cast<double>(points)));
    return std::clamp<std::uint64_t>(part, 1, std::max<std::uint64_t>(points - 1, 1));
}

}  // namespace

EmissionPoints declare_points(graph::GraphBuilder& builder, const Sources& sources,
                              const Parameters& parameters) {
    EmissionPoints points;
    const auto requested =
        static_cast<std::uint64_t>(std::max(1, parameters.photons / parameters.photons_per_point));
    if (sources.flux() > 0) points.count = requested;
    points.from_maps = points_from_maps(sources, points.count);
    auto& samples = points.samples;
    samples.photons_per_point = parameters.photons_per_point;
    samples.paths = points.count * static_cast<std::uint64_t>(parameters.photons_per_point);
    if (samples.paths > 0)
        samples.power_unit = std::max(sources.flux(), sources.largest_flux / largest_power) /
                             static_cast<float>(samples.paths);
    const double reserved =
        std::ceil(static_cast<double>(parameters.reserve) * static_cast<double>(requested));
    samples.points = builder.output(
        "photons.samples", {.fields = record_fields<SamplePoint>(),
                            .elements = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(reserved)),
                            .growable = true});
    samples.count = builder.counter({.key = "photons.sample_count",
                                     .label = "Sample points",
                                     .doc = "Points of the emission sets that survive.",
                                     .growth_of = samples.points});
    samples.sources = builder.output(
        "photons.sources",
        {.fields = record_fields<SourceData>(),
         .elements = std::max<std::uint64_t>(1, sources.layers.size() + sources.traced_rows.size())});
    points.candidates =
        words(builder,
              {.key = "emission.candidates",
               .label = "Emission points",
               .doc = "For each point of a map's emission set where it came to: bits 0-9 texel "
                      "x, 10-19 texel y, 20-25 source, 26 set where it survives."},
              "place", points.from_maps);
    points.survivors = words(builder,
                             {.key = "emission.survivors",
                              .label = "Surviving points",
                              .doc = "1 for each point of the emission sets that survives the roulette."},
                             "survives", points.count);
    return points;
}

void divide_points(graph::GraphBuilder& builder, const Sources& sources, const EmissionPoints& points,
                   const EmissionMaps* maps, std::optional<graph::BufferRef> traced,
                   const Parameters& parameters) {
    const auto without = builder.counter({.key = "emission.sources_without_points",
                                          .label = "Lights without photons",
                                          .doc = "Maps of lights, or lights that rays are traced from, that "
                                                 "shine, but whose share is less than half a photon: their "
                                                 "light is missing."});
    const bool by_probability = maps && parameters.budget == Budget::probability;
    auto pass = builder.pass("photon budget");
    if (by_probability) pass.reads("haar_pyramid", maps->haar);
    if (traced) pass.reads("TracedSources", *traced);
    pass.writes("Sources", points.samples.sources).counts("WithoutPoints", without);
    const auto used = by_probability ? std::optional(*maps) : std::nullopt;
    pass.execute([=](PassContext& p) { divide(p, sources, points, used ? &*used : nullptr); });
}

void find_places(graph::GraphBuilder& builder, EmissionPoints& points) {
    points.places = passes::exclusive_scan(builder, "emission.survivors", points.survivors, points.count,
                                           points.samples.count);
}

namespace {

void read_maps(graph::PassBuilder& pass, const passes::SceneBuffers& scene, const MappedEmission& mapped,
               const EmissionPoints& points) {
    reads_map(pass, mapped.rsm, scene);
    pass.reads("probability_map", mapped.maps.probability)
        .reads("haar_pyramid", mapped.maps.haar)
        .reads("Sources", points.samples.sources);
}

}  // namespace

void warp_points(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Sources& sources,
                 const MappedEmission& mapped, const EmissionPoints& points, const Parameters& parameters) {
    auto pass = builder.pass("emission points");
    read_maps(pass, scene, mapped, points);
    pass.writes("Candidates", points.candidates).writes("Survivors", points.survivors);
    pass.compute_sliced(source_over_maps("methods/photon-mapping/emission/points.comp", parameters),
                        static_cast<std::int64_t>(points.from_maps),
                        WarpPoints{surface_rules(*builder.inputs().scene, parameters),
                                   emission_sets(builder.inputs(), sources, points, parameters)},
                        first_points_slice);
}

void pack_points(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Sources& sources,
                 const MappedEmission& mapped, const EmissionPoints& points, const Parameters& parameters) {
    const WarpPoints warped{surface_rules(*builder.inputs().scene, parameters),
                            emission_sets(builder.inputs(), sources, points, parameters)};
    auto pass = builder.pass("sample points");
    read_maps(pass, scene, mapped, points);
    pass.reads("Candidates", points.candidates)
        .reads("Places", points.places)
        .writes("Samples", points.samples.points);
    pass.compute_sliced(
        source_over_maps("methods/photon-mapping/emission/samples.comp", parameters),
        static_cast<std::int64_t>(points.from_maps),
        [=, samples = points.samples](const PassContext& p) {
            return PackPoints{warped, static_cast<unsigned>(p.capacity(samples.points)), samples.power_unit,
                              static_cast<float>(samples.photons_per_point)};
        },
        first_points_slice);
}

EmissionSets emission_sets(const graph::FrameInputs& inputs, const Sources& sources,
                           const EmissionPoints& points, const Parameters& parameters) {
    const auto strata = parameters.renews_photons() ? 1u : static_cast<unsigned>(parameters.strata);
    const auto seed = photon_seed(inputs, parameters);
    return {.source_count = static_cast<unsigned>(sources.layers.size()),
            .all_points = static_cast<unsigned>(points.count),
            .strata = strata,
            .stratum = static_cast<unsigned>(inputs.frame) % strata,
            .seed_low = static_cast<unsigned>(seed),
            .seed_high = static_cast<unsigned>(seed >> 32)};
}

std::vector<OutputDescription> point_outputs() {
    return {
        {.key = "photons.samples",
         .label = "Sample points",
         .kind = OutputKind::point_set,
         .semantic = Semantic::position,
         .unit = "m",
         .doc = "Where photons leave: points that survived the roulette at the first surface, in the "
                "order of their seeds; before mirrors and glass, places on the light's rays. power: RGB9E5; "
                "normals and arrived_from, where the light came from: octahedral; surface: base colour and "
                "roughness; light: number of the light (61: a later one, 62: an emissive surface, 63: the "
                "environment), metalness; ior: index of refraction; origin: texel x and y and layer of the "
                "RSM, or all bits where a ray was traced from the light."},
        {.key = "photons.sources",
         .label = "Sources of photons",
         .kind = OutputKind::table,
         .doc = "One element per layer of the RSM; then, with is_traced 1, one per light that rays are "
                "traced from, for all emissive surfaces and for the environment: its place, direction, "
                "light (61: later than the 60th, 62: emissive surfaces, 63: the environment), intensity, "
                "flux (W, mean of the channels; textures and maps estimated), and which points of the "
                "emission sets it has."}};
}

}  // namespace ir::methods::photon_mapping
