#include "renderers/methods/ldm-indirect/splatting/stored.h"

#include "renderers/methods/ldm-indirect/looks.h"
#include "renderers/methods/ldm-indirect/parameters.h"
#include "renderers/passes/ldm/directions.h"

namespace ir::methods::ldm_indirect {
namespace {

using Paths = Transport::Paths;

/// Constants of clipping.glsl.
struct Units {
    float units_per_metre;
    unsigned look_maps;
    IR_FIELDS(units_per_metre, look_maps)
};

void measure(const graph::PassContext& p, graph::Slice slice, const StoredPhotons& photons) {
    const auto& program = p.use({{folder + "measure.comp"}});
    program.set(footprints(p.inputs(), photons));
    passes::dispatch_photons(p, program, photons, slice);
}

}  // namespace

std::vector<glm::vec4> arrivals_of(const Parameters& parameters, const scene::World& world) {
    std::vector<glm::vec4> all;
    for (const auto& direction : passes::ldm::leopardi_directions(parameters.maps.directions))
        all.emplace_back(glm::vec3(glm::normalize(parameters.maps.rotation * direction.centre)), 0.0f);
    for (const auto& light : world.lights) {
        const bool far = light.type == scene::LightType::directional;
        all.emplace_back(far ? light.direction : light.position, far ? 0.0f : 1.0f);
    }
    return all;
}

graph::BufferRef upload_arrivals(graph::GraphBuilder& builder, const Parameters& parameters) {
    auto arrivals = arrivals_of(parameters, *builder.inputs().world);
    graph::BufferDesc desc;
    desc.text = {.key = "splat.arrivals",
                 .label = "Where light comes from",
                 .doc =
                     "Directions of the maps, then the lights: their places (w 1), or where they shine to "
                     "(w 0)."};
    desc.fields = {{"arrival", graph::FieldType::f32, 4}};
    desc.elements = arrivals.size();
    const auto& world = builder.inputs().world_fingerprint;
    desc.fingerprint = world.empty() || parameters.progressive
                           ? ""
                           : world + " from " + std::to_string(parameters.maps.directions) + " directions";
    const auto buffer = builder.buffer(std::move(desc));
    builder.pass("upload arrivals").writes(buffer).execute([=](graph::PassContext& p) {
        p.upload(buffer, std::as_bytes(std::span(arrivals)));
    });
    return buffer;
}

MendedCounters declare_mended(graph::GraphBuilder& builder) {
    return {builder.counter({.key = "splat.short",
                             .label = "Footprints widened",
                             .doc = "Photons with an axis shorter than min_axis_pixels, which was made so "
                                    "long; their flux stays."}),
            builder.counter({.key = "splat.long",
                             .label = "Footprints cut",
                             .doc = "Photons with an axis longer than max_axis, which was cut to it; "
                                    "their flux stays."}),
            builder.counter({.key = "splat.degenerate",
                             .label = "Degenerate footprints",
                             .doc = "Photons whose axes span no area or are no numbers, given the minimum "
                                    "width; their flux stays."}),
            builder.counter({.key = "splat.not_finite",
                             .label = "Photons left out",
                             .doc = "Photons whose place or flux is no finite number: they add nothing."})};
}

StoredPhotons stored_photons(graph::GraphBuilder& builder, const Photons& photons,
                             const Parameters& parameters) {
    const auto arrivals = photons.arrivals ? *photons.arrivals : upload_arrivals(builder, parameters);
    if (photons.stored)
        return {{photons.records, *photons.stored}, arrivals, parameters, photons.count, photons.looks};
    const StoredPhotons result{passes::photon_list(builder, photons.records), arrivals, parameters,
                               photons.count, photons.looks};
    builder.pass("stored photons")
        .reads(photons.records)
        .writes("Stored", result.stored)
        .counts("Count", photons.count)
        .execute([=](graph::PassContext& p) { passes::count_stored(p, result); });
    return result;
}

StoredPhotons splatted_photons(const Photons& photons, const Splat& splat, const Parameters& parameters) {
    return {{photons.records, splat.stored}, splat.arrivals, parameters, photons.count, photons.looks};
}

void measure_footprints(graph::GraphBuilder& builder, const StoredPhotons& photons) {
    const auto mended = declare_mended(builder);
    auto pass = builder.pass("measure footprints");
    reads_footprints(pass, photons);
    // A pass that only counts would be left out: who reads how many photons there are has them measured.
    pass.writes(photons.stored)
        .counts("Short", mended.axes_short)
        .counts("Long", mended.axes_long)
        .counts("Degenerate", mended.degenerate)
        .counts("Broken", mended.broken)
        .execute_sliced(passes::photon_parts,
                        [=](graph::PassContext& p, graph::Slice slice) { measure(p, slice, photons); });
}

void reads_footprints(graph::PassBuilder& pass, const StoredPhotons& photons) {
    pass.reads("Photons", photons.records)
        .reads("Stored", photons.stored)
        .reads("Arrivals", photons.arrivals);
}

void reads_looks(graph::PassBuilder& pass, const StoredPhotons& photons) {
    if (photons.looks) pass.reads("Looks", *photons.looks);
}

void define_clipped(gl::ProgramSource& source, const StoredPhotons& photons) {
    if (photons.looks) source.defines["CLIPPED"] = "1";
}

void set_units(const graph::PassContext& context, const gl::Program& program, const StoredPhotons& photons) {
    if (photons.looks)
        program.set(Units{units_per_metre(*context.inputs().world),
                          static_cast<unsigned>(photons.parameters.maps.directions)});
}

Footprints footprints(const graph::FrameInputs& inputs, const StoredPhotons& photons) {
    const auto& parameters = photons.parameters;
    const bool by_photons = parameters.direct == DirectBy::photons;
    return {.ellipses = ellipses(inputs, parameters),
            .map_count = static_cast<unsigned>(parameters.maps.directions),
            .light_count = static_cast<unsigned>(inputs.world->lights.size()),
            .count_indirect = parameters.transport.paths != Paths::direct,
            .count_direct = by_photons && parameters.transport.paths != Paths::indirect,
            .turns_receivers = parameters.landing == LandingBy::plane,
            .clips = photons.looks.has_value()};
}

Outlines outlines(const graph::FrameInputs& inputs, const StoredPhotons& photons) {
    const auto& view = inputs.view;
    return {footprints(inputs, photons), view.clip_from_world(), {view.width, view.height}};
}

}  // namespace ir::methods::ldm_indirect
