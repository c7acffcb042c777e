#include "renderers/methods/photon-mapping/stages.h"

#include <algorithm>

#include "renderers/core/record.h"
#include "renderers/methods/photon-mapping/bounces.h"
#include "renderers/methods/photon-mapping/tracing/wavefront.h"
#include "shaders/methods/photon-mapping/records.glsl.h"
#include "shaders/methods/photon-mapping/tracing/locations.comp.h"
#include "shaders/methods/photon-mapping/tracing/tally.comp.h"

namespace ir::methods::photon_mapping {
namespace {

using graph::GraphBuilder;
using graph::PassContext;

/// As many as memory is reserved for at first: the buffer grows.
std::uint64_t reserved_photons(const SamplePoints& samples, const Parameters& parameters) {
    return std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(static_cast<double>(samples.paths) * parameters.reserve));
}

Photons declare_photons(GraphBuilder& builder, const SamplePoints& samples, const Parameters& parameters) {
    Photons photons;
    photons.power_unit = samples.power_unit;
    graph::BufferDesc records;
    records.text = {.key = "photons.records",
                    .label = "Photons",
                    .doc = "As they are splatted, 32 bytes each, by bounce and path."};
    records.fields = record_fields<Photon>();
    records.elements = reserved_photons(samples, parameters);
    records.growable = true;
    photons.records = builder.buffer(records);
    photons.count = builder.counter({.key = "photons.count",
                                     .label = "Photons stored",
                                     .doc = "On all bounces, without those that were culled.",
                                     .growth_of = photons.records});
    return photons;
}

/// Constants of tally.comp.
struct TallyPhotons {
    unsigned rows;
    float power_unit;
    IR_FIELDS(rows, power_unit)
};

void declare_tally(GraphBuilder& builder, const Wavefront& wavefront, const SamplePoints& samples) {
    const auto rows = wavefront.rows();
    const auto table = builder.output(
        "photons.tally", {.fields = record_fields<TallyRow>(), .elements = static_cast<std::uint64_t>(rows)});
    auto pass = builder.pass("tally photons");
    pass.reads("Sums", wavefront.sums()).writes("Table", table);
    pass.counts("RayCounter", builder.counter({.key = "photons.rays", .label = "Rays of photons"}))
        .counts("MissedCounter",
                builder.counter({.key = "photons.missed", .label = "Photons that left the scene"}))
        .counts("CulledCounter", builder.counter({.key = "photons.culled", .label = "Photons culled"}))
        .counts("AbsorbedCounter", builder.counter({.key = "photons.absorbed", .label = "Photons absorbed"}))
        .counts("CutCounter",
                builder.counter({.key = "photons.cut",
                                 .label = "Photons cut",
                                 .doc = "Their paths met more mirrors and clear glass than are followed."}));
    gl::ProgramSource source{{"methods/photon-mapping/tracing/tally.comp"}};
    if (samples.weights) {
        source.defines["WEIGHS"] = "1";
        pass.counts("SeenCounter",
                    builder.counter({.key = "photons.seen",
                                     .label = "Photons seen",
                                     .doc = "Those that raise the weight of the texel they came from."}));
    }
    pass.compute(source, rows, TallyPhotons{static_cast<unsigned>(rows), samples.power_unit});
}

/// Constants of locations.comp.
struct LocatePhotons {
    unsigned capacity;
    float power_unit;
    IR_FIELDS(capacity, power_unit)
};

void declare_locations(GraphBuilder& builder, const Photons& photons, std::uint64_t most,
                       std::uint64_t reserved) {
    const auto locations =
        builder.output("photons.locations",
                       {.fields = record_fields<PhotonLocation>(), .elements = reserved, .growable = true});
    const auto located = builder.counter(
        {.key = "photons.located", .label = "Photons shown in space", .growth_of = locations});
    auto pass = builder.pass("photon locations");
    pass.reads("Records", photons.records)
        .writes("Locations", locations)
        .counts("RecordCount", photons.count)
        .counts("LocationCount", located);
    pass.compute_sliced(
        {{"methods/photon-mapping/tracing/locations.comp"}}, static_cast<std::int64_t>(most),
        [=](const PassContext& context) {
            const auto capacity = std::min(context.capacity(locations), context.capacity(photons.records));
            return LocatePhotons{static_cast<unsigned>(capacity), photons.power_unit};
        },
        4096);
}

}  // namespace

Photons trace_photons(GraphBuilder& builder, const passes::SceneBuffers& scene, const SamplePoints& samples,
                      const Parameters& parameters) {
    auto photons = declare_photons(builder, samples, parameters);
    const Wavefront wavefront(builder, scene, samples, parameters);
    photons.legs = wavefront.legs();
    wavefront.leave(builder, photons);
    for (int number = 1; number <= wavefront.surfaces(); ++number)
        wavefront.advance(builder, number, photons);
    declare_tally(builder, wavefront, samples);
    declare_locations(builder, photons, samples.paths * static_cast<std::uint64_t>(wavefront.surfaces()),
                      reserved_photons(samples, parameters));
    return photons;
}

std::vector<OutputDescription> tracing_outputs() {
    return {
        {.key = "photons.locations",
         .label = "Photon locations",
         .kind = OutputKind::point_set,
         .unit = "m",
         .doc =
             "All photons that are stored. normal: of the triangle, on the side that was hit. direction: to "
             "where the photon came from. power: W, red, green and blue. ray_length: metres since the last "
             "scattering, or since the first mirror or glass. light: number of the light (61: a later one, "
             "62: an emissive surface, 63: the environment). seed: the low 20 bits of the sample point's "
             "seed; photons of one seed share their path.",
         .categories = {bounce_categories("bounce")},
         .explains = true},
        {.key = "photons.tally",
         .label = "Photons by bounce",
         .kind = OutputKind::table,
         .doc =
             "A row for the sample points (bounce 0) and one for each bounce. rays: photons that were "
             "traced there; of the sample points, how many there are. missed: they left the scene or found "
             "nothing within the maximum distance. stored and culled: where they hit. absorbed: not "
             "scattered on there. cut: met more mirrors and clear glass than are followed. power: W, of those "
             "stored and culled; of the sample points, before the first scattering."},
    };
}

}  // namespace ir::methods::photon_mapping
