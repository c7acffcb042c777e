#include "renderers/methods/ldm-indirect/stages.h"

#include <algorithm>
#include <limits>

#include "renderers/core/error.h"
#include "renderers/core/record.h"
#include "renderers/methods/ldm-indirect/looks.h"
#include "renderers/methods/ldm-indirect/tracing/emission.h"
#include "renderers/methods/ldm-indirect/tracing/energy.h"
#include "renderers/methods/ldm-indirect/tracing/further_bounces.h"
#include "renderers/methods/ldm-indirect/tracing/host/split_on_host.h"
#include "renderers/methods/ldm-indirect/tracing/one_pass.h"
#include "renderers/methods/ldm-indirect/tracing/splitting.h"
#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/ldm/coarse_scene.h"
#include "renderers/passes/ldm/host/trace_on_host.h"
#include "renderers/passes/ldm/map_views.h"
#include "renderers/passes/ldm/sky.h"

namespace ir::methods::ldm_indirect {
namespace {

namespace ldm = passes::ldm;

bool has_indirect(const Parameters& parameters) {
    return parameters.transport.paths != Transport::Paths::direct;
}

bool has_direct_photons(const Parameters& parameters) {
    return parameters.transport.paths != Transport::Paths::indirect && parameters.direct == DirectBy::photons;
}

/// As many as there can be.
std::uint64_t max_photons(const Primaries& primaries, const Parameters& parameters) {
    const auto maps = static_cast<std::uint64_t>(parameters.maps.directions);
    return primaries.count() * (has_indirect(parameters) ? maps : 0) +
           primaries.from_images * has_direct_photons(parameters);
}

/// Counters hold 32 bits, scans 2^26 items.
void refuse_beyond_counters(const Primaries& primaries, std::uint64_t most, const Parameters& parameters) {
    constexpr std::uint64_t max_primaries = std::uint64_t{1} << 26;
    if (primaries.count() <= max_primaries && most <= std::numeric_limits<std::uint32_t>::max()) return;
    throw Error(
        "indirect light: " + std::to_string(primaries.count()) +
        " photons of lights and further bounces, up to " + std::to_string(most) +
        " after they are split into " + std::to_string(parameters.maps.directions) +
        " directions, are more than can be counted (2^26, 2^32); lower 'emission', 'directions' or 'max_bounces'");
}

/// Of which memory is reserved at first: 256 MiB. What is stored beyond is found by growing once.
constexpr std::uint64_t max_reserved = std::uint64_t{1} << 22;

std::uint64_t reserved_photons(std::uint64_t most, const Parameters& parameters) {
    const double part = static_cast<double>(most) * static_cast<double>(parameters.reserve);
    return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(part), 1, max_reserved);
}

/// Whether maps are queried for the environment's direct light.
bool queries_sky(const graph::FrameInputs& inputs, const Parameters& parameters) {
    return parameters.transport.paths != Transport::Paths::indirect &&
           parameters.environment_by == EnvironmentBy::maps &&
           passes::extended_sources(inputs,
                                    passes::extended_light_options(parameters.light, parameters.transport))
               .environment;
}

Photons declare_photons(graph::GraphBuilder& builder, std::uint64_t reserved) {
    Photons photons;
    photons.records = builder.output(
        "indirect.photons", {.fields = record_fields<Photon>(), .elements = reserved, .growable = true});
    photons.count = builder.counter({.key = "indirect.count",
                                     .label = "Photons stored",
                                     .doc = "Photons that the camera sees, which are splatted.",
                                     .growth_of = photons.records});
    return photons;
}

/// So that it is there, and holds nothing, where nothing is stored.
void begin_photons(graph::GraphBuilder& builder, const Photons& photons) {
    builder.pass("begin photons").writes(photons.records).counts(photons.count).execute([](auto&) {});
}

}  // namespace

Photons trace_photons(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                      const passes::GBuffer& gbuffer, const Parameters& parameters) {
    const auto images = draw_light_images(builder, scene, parameters);
    const auto maps = ldm::declare_maps(builder, parameters.maps);
    const auto primaries = emit_photons(builder, scene, images, maps, parameters);
    const auto most = max_photons(primaries, parameters);
    refuse_beyond_counters(primaries, most, parameters);
    auto photons = declare_photons(builder, reserved_photons(most, parameters));
    photons.maps = maps;
    const bool host_has_maps =
        ldm::has_host_body(maps->options) && builder.inputs().processor == Processor::host;
    const bool on_host = has_indirect(parameters) && host_has_maps && traces_on_host(parameters);
    if (!on_host) begin_photons(builder, photons);
    std::optional<graph::BufferRef> fates;
    if (has_direct_photons(parameters))
        fates = store_directly(builder, gbuffer, primaries, photons, parameters);

    const auto chosen = ldm::chosen_maps(builder.inputs().inspection, *maps);
    ldm::show_directions(builder, maps);
    const auto layers = ldm::declare_layers(builder, *maps);
    const auto points = ldm::declare_points(builder, *maps, chosen);
    photons.looks = declare_looks(builder, parameters);
    if (parameters.splatting == Splatting::one_pass) begin_one_pass(builder, photons, parameters);
    std::optional<Splitter> splitter;
    if (on_host)
        split_on_host(builder, gbuffer, maps, primaries, photons, fates, parameters);
    else if (has_indirect(parameters))
        splitter.emplace(builder, scene, gbuffer, maps, primaries, photons, parameters);
    std::optional<ldm::Sky> sky;
    if (queries_sky(builder.inputs(), parameters)) sky = ldm::declare_sky(builder, maps, {});
    if (sky && host_has_maps)
        ldm::trace_sky_on_host(builder, gbuffer, ldm::declare_meshlets(builder, maps->options.detail), maps,
                               *sky, ldm::self_hit_rule(parameters.maps));
    const auto of_maps = ldm::map_scene(builder, scene, maps->options.detail);
    // Beside the host's passes whole maps are built only while something looks at them.
    for (int batch = 0; batch < maps->layout.batches(); ++batch) {
        ldm::build_maps(builder, of_maps, maps, batch);
        if (splitter) splitter->split(builder, batch);
        if (splitter && photons.looks) look_from_pixels(builder, gbuffer, maps, batch, *photons.looks);
        if (photons.sums) trace_and_splat(builder, gbuffer, maps, batch, primaries, photons, parameters);
        if (sky && !host_has_maps)
            ldm::trace_sky(builder, gbuffer, maps, batch, *sky, "methods/ldm-indirect/sky.comp");
        ldm::show_layers(builder, maps, batch, chosen, layers);
        ldm::find_points(builder, of_maps, maps, batch, points);
    }
    ldm::show_sheets(builder, *maps, points);
    if (sky) {
        ldm::finish_sky(builder, *sky, parameters.progressive);
        photons.sky = sky->light;
    }
    photons.texels = primaries.from_images;
    photons.primaries = primaries.records;
    sum_bounces(builder, primaries);
    sum_energy(builder, primaries, has_indirect(parameters), fates);
    show_primaries(builder, primaries);
    show_photons(builder, photons, reserved_photons(most, parameters), most);
    return photons;
}

std::vector<OutputDescription> tracing_outputs() {
    std::vector<OutputDescription> outputs{
        {.key = "indirect.photons",
         .label = "Photons",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc =
             "The stored photons as they are splatted, 80 bytes each, with half of their differentials as "
             "axes. leg: bits 0-15 map; bit 16: 1 along its direction, 0 against it; bit 17: directly "
             "from the light; bits 18-23: 64ths of the footprint that lie beyond its surface; bits 24-31: "
             "light, 254 an emissive mesh, 255 the environment. flux: W. normal: of the receiver, octahedral "
             "in 2 x 16 bits."}};
    return joined({outputs,
                   energy_outputs(),
                   bounce_outputs(),
                   view_outputs(),
                   passes::rsm_outputs({}, true),
                   ldm::map_outputs(),
                   {ldm::sky_output({"environment_by", {std::string("maps")}})}});
}

std::vector<SelectorDescription> tracing_selectors() {
    return {ldm::map_selector_description()};
}

}  // namespace ir::methods::ldm_indirect
