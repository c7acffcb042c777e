#include "renderers/methods/deep-screen-space/surfels.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/methods/deep-screen-space/surfels/steps.h"
#include "shaders/methods/deep-screen-space/surfels/stored.comp.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Constants of parts.glsl.
struct FirstPart {
    unsigned first_part;
    IR_FIELDS(first_part)
};

}  // namespace

void dispatch_parts(const gl::Program& program, std::uint64_t capacity, graph::Slice slice) {
    constexpr std::int64_t block = 64;
    const auto blocks = (static_cast<std::int64_t>(capacity) + block - 1) / block;
    program.set(FirstPart{static_cast<unsigned>(slice.begin)});
    program.dispatch(block * (slice.end - slice.begin), (blocks + packing_parts - 1) / packing_parts);
}

Growing growing(graph::GraphBuilder& builder, graph::BufferDesc desc, graph::CounterDesc counter,
                std::uint64_t reserve) {
    desc.elements = std::max<std::uint64_t>(1, reserve);
    desc.growable = true;
    desc.lower = "the number of surfels (raise 'surfel_radius')";
    Growing result;
    result.buffer = builder.buffer(std::move(desc));
    counter.growth_of = result.buffer;
    result.count = builder.counter(std::move(counter));
    return result;
}

namespace {

/// Constants of stored.comp.
struct CountStored {
    unsigned capacity;
    IR_FIELDS(capacity)
};

}  // namespace

std::span<const Surfel> stored_surfels(const graph::PassContext& context, const Surfels& surfels) {
    const auto stored = context.elements<const StoredSurfels>(surfels.stored)[0].stored;
    return context.elements<const Surfel>(surfels.records).first(stored);
}

Surfels declare_surfels(graph::GraphBuilder& builder, const Growing& records,
                        const std::string& fingerprint) {
    Surfels surfels{records.buffer, records.count, {}, {}, fingerprint};
    surfels.stored =
        builder.buffer({.text = {.key = "surfels.stored",
                                 .label = "Surfels to read",
                                 .doc = "stored: those made, as far as the buffer reaches; made: all.",
                                 .semantic = Semantic::count},
                        .fields = record_fields<StoredSurfels>(),
                        .elements = 1,
                        .fingerprint = fingerprint});
    return surfels;
}

Surfels count_stored(graph::GraphBuilder& builder, const Growing& records, const std::string& fingerprint) {
    const auto surfels = declare_surfels(builder, records, fingerprint);
    builder.pass("count stored surfels")
        .reads(surfels.records)
        .writes("Stored", surfels.stored)
        .counts("Count", surfels.count)
        .compute({{"methods/deep-screen-space/surfels/stored.comp"}}, 1, [=](const graph::PassContext& p) {
            return CountStored{static_cast<unsigned>(p.capacity(surfels.records))};
        });
    return surfels;
}

Growing declare_records(graph::GraphBuilder& builder, std::uint64_t reserve, const std::string& fingerprint) {
    return growing(builder,
                   {.text = {.key = "surfels.records",
                             .label = "Surfels, as passes read them",
                             .doc = "As the output \"surfels\"; identity: a hash of the surfel's place, of "
                                    "which random choices about it are made; order: its number, those near "
                                    "each other in it lie near each other."},
                    .kind = OutputKind::glyphs,
                    .fields = record_fields<Surfel>(),
                    .fingerprint = fingerprint},
                   {.key = "surfels.kept", .label = "Surfels", .doc = "That are left by thinning."}, reserve);
}

Surfels make_surfels(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                     const passes::ShadowMaps& shadow, float reach, const Parameters& parameters) {
    const auto& view = builder.inputs().view;
    const double pixels = static_cast<double>(view.width) * view.height;
    const double triangles = static_cast<double>(builder.inputs().world->indices.size()) / 3;
    const auto room_for = [&](double per_pixel, double per_triangle) {
        return static_cast<std::uint64_t>(
            std::ceil(parameters.reserve * (per_pixel * pixels + per_triangle * triangles)));
    };
    const auto reserve = room_for(1, 0);
    const auto kept_while = surfel_fingerprint(builder.inputs(), reach, parameters);
    const bool systematic = parameters.placement == Placement::systematic;
    std::optional<Growing> fine;
    if (!systematic)
        fine = declare_fine(builder, room_for(2, 0.65), kept_while);  // three for a triangle however small
    const auto on_device = [&]() -> Placed {
        const auto patches = cut_patches(builder, scene, fine ? fine->count : declare_units(builder), reach,
                                         room_for(0.1, 0.25), parameters, kept_while);
        if (!fine) return {patches, place(builder, scene, patches, reserve, parameters, kept_while)};
        tessellate(builder, scene, patches, *fine, parameters, kept_while);
        return {patches, thin(builder, scene, *fine, reserve, parameters, kept_while)};
    };
    auto [patches, surfels] = systematic && builder.inputs().processor == Processor::host
                                  ? place_on_host(builder, reach, reserve, parameters, kept_while)
                                  : on_device();
    if (parameters.transport.paths != Transport::Paths::ao)
        surfels.lights = shade(builder, scene, shadow, surfels, parameters);
    show_surfels(builder, surfels, reserve, parameters);
    count_surfels(builder, patches, fine ? &*fine : nullptr, surfels, parameters);
    return surfels;
}

}  // namespace ir::methods::deep_screen_space
