#include "renderers/methods/ldm-indirect/tracing/emission.h"

#include "renderers/core/record.h"
#include "renderers/passes/ldm/map_views.h"
#include "renderers/passes/scan/scan.h"
#include "shaders/methods/ldm-indirect/tracing/show_photons.comp.h"
#include "shaders/methods/ldm-indirect/tracing/show_primary.comp.h"

namespace ir::methods::ldm_indirect {
namespace {

using graph::PassContext;

constexpr const char* primary_shader = "methods/ldm-indirect/tracing/show_primary.comp";
constexpr std::int64_t first_slice = 4096;

/// Constants of show_primary.comp with PACK.
struct ShowPrimary {
    unsigned capacity;
    IR_FIELDS(capacity)
};

/// Constants of show_photons.comp.
struct ShowPhotons {
    unsigned capacity, shown_capacity;
    IR_FIELDS(capacity, shown_capacity)
};

graph::BufferRef glyphs(graph::GraphBuilder& builder, const std::string& key,
                        std::vector<graph::Field> fields, std::uint64_t elements) {
    return builder.output(key, {.fields = std::move(fields), .elements = elements, .growable = true});
}

}  // namespace

Categories side_categories() {
    return {"side",
            {passes::ldm::against_map, {0, "from the light itself", tints::yellow}, passes::ldm::along_map}};
}

void show_primaries(graph::GraphBuilder& builder, const Primaries& primaries) {
    const auto shown = glyphs(builder, "indirect.primary", record_fields<ShownPrimary>(), primaries.count());
    const auto count = builder.counter(
        {.key = "indirect.primaries_shown", .label = "Primary photons shown", .growth_of = shown});
    graph::BufferDesc flagged;
    flagged.text.key = "indirect.primary_flags";
    flagged.text.label = "Whether primary photons are shown";
    flagged.fields = {{"count", graph::FieldType::u32}};
    flagged.elements = primaries.count();
    const auto flags = builder.buffer(std::move(flagged));
    builder.pass("find primary photons")
        .reads("Primaries", primaries.records)
        .writes("Counts", flags)
        .compute_sliced({{primary_shader}}, static_cast<std::int64_t>(primaries.count()), {}, first_slice);
    const auto places =
        passes::exclusive_scan(builder, "indirect.primary_scan", flags, primaries.count(), count);
    builder.pass("show primary photons")
        .reads("Primaries", primaries.records)
        .reads("Places", places)
        .writes("AllShown", shown)
        .compute_sliced(
            {{primary_shader}, {{"PACK", "1"}}}, static_cast<std::int64_t>(primaries.count()),
            [=](const PassContext& context) {
                return ShowPrimary{static_cast<unsigned>(context.capacity(shown))};
            },
            first_slice);
}

void show_photons(graph::GraphBuilder& builder, const Photons& photons, std::uint64_t reserved,
                  std::uint64_t most) {
    const auto shown = glyphs(builder, "indirect.footprints", record_fields<ShownPhoton>(), reserved);
    const auto count = builder.counter(
        {.key = "indirect.footprints_shown", .label = "Footprints shown", .growth_of = shown});
    auto pass = builder.pass("show footprints");
    if (photons.stored)
        pass.reads("StoredCount", *photons.stored);
    else
        pass.counts("StoredCount", photons.count);
    pass.reads("Photons", photons.records)
        .writes("AllShown", shown)
        .counts("ShownCount", count)
        .compute_sliced(
            {{"methods/ldm-indirect/tracing/show_photons.comp"}}, static_cast<std::int64_t>(most),
            [=, records = photons.records](const PassContext& context) {
                return ShowPhotons{static_cast<unsigned>(context.capacity(records)),
                                   static_cast<unsigned>(context.capacity(shown))};
            },
            first_slice);
}

std::vector<OutputDescription> view_outputs() {
    return {
        {.key = "indirect.primary",
         .label = "Primary photons",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc = "Photons where they meet the first surface, as parallelograms of their differentials. "
                "normal: the shading normal. direction: of travel. flux: W, on arrival. source: texel of "
                "the lights' images; behind them stand photons of sources with an extent. light: 254 an "
                "emissive mesh, 255 the environment.",
         .explains = true},
        {.key = "indirect.footprints",
         .label = "Footprints",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc = "The stored photons with their differentials, before splatting scales and limits them. "
                "map and side: the direction that they came along. flux: W. path_length: m from the light. "
                "light: 254 an emissive mesh, 255 the environment.",
         .categories = {side_categories(),
                        {"direct",
                         {{0, "from a surface", tints::sky}, {1, "from the light itself", tints::yellow}}}},
         .explains = true}};
}

}  // namespace ir::methods::ldm_indirect
