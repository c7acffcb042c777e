#include "renderers/methods/ldm-indirect/tracing/views.h"

#include "renderers/gl/dispatch_items.h"
#include "renderers/methods/ldm-indirect/sides.h"
#include "renderers/passes/scan/scan.h"

namespace ir::methods::ldm_indirect {
namespace {

using graph::FieldType;
using graph::PassContext;
using graph::Slice;

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

void show_primaries(graph::GraphBuilder& builder, const Primaries& primaries) {
    const auto shown = glyphs(builder, "indirect.primary",
                              {{"centre", FieldType::f32, 3},
                               {"axis_u", FieldType::f32, 3},
                               {"axis_v", FieldType::f32, 3},
                               {"normal", FieldType::f32, 3},
                               {"direction", FieldType::f32, 3},
                               {"flux", FieldType::f32, 3},
                               {"luminance"},
                               {"path_length"},
                               {"light", FieldType::u32},
                               {"source", FieldType::u32}},
                              primaries.count);
    const auto count = builder.counter(
        {.key = "indirect.primaries_shown", .label = "Primary photons shown", .growth_of = shown});
    graph::BufferDesc flagged;
    flagged.text.key = "indirect.primary_flags";
    flagged.text.label = "Whether primary photons are shown";
    flagged.fields = {{"count", FieldType::u32}};
    flagged.elements = primaries.count;
    const auto flags = builder.buffer(std::move(flagged));
    builder.pass("find primary photons")
        .reads("Primaries", primaries.records)
        .writes("Counts", flags)
        .execute_sliced(
            static_cast<std::int64_t>(primaries.count),
            [=](PassContext& context, Slice slice) {
                const auto& program = context.use({{primary_shader}});
                gl::dispatch_items(program, slice.begin, slice.end);
            },
            first_slice);
    const auto places =
        passes::exclusive_scan(builder, "indirect.primary_scan", flags, primaries.count, count);
    builder.pass("show primary photons")
        .reads("Primaries", primaries.records)
        .reads("Places", places)
        .writes("AllShown", shown)
        .execute_sliced(
            static_cast<std::int64_t>(primaries.count),
            [=](PassContext& context, Slice slice) {
                gl::ProgramSource source{{primary_shader}};
                source.defines["PACK"] = "1";
                const auto& program = context.use(source);
                program.set(ShowPrimary{static_cast<unsigned>(context.capacity(shown))});
                gl::dispatch_items(program, slice.begin, slice.end);
            },
            first_slice);
}

void show_photons(graph::GraphBuilder& builder, const Photons& photons, std::uint64_t reserved,
                  std::uint64_t most) {
    const auto shown = glyphs(builder, "indirect.footprints",
                              {{"centre", FieldType::f32, 3},
                               {"axis_u", FieldType::f32, 3},
                               {"axis_v", FieldType::f32, 3},
                               {"normal", FieldType::f32, 3},
                               {"flux", FieldType::f32, 3},
                               {"luminance"},
                               {"path_length"},
                               {"map", FieldType::u32},
                               {"side", FieldType::i32},
                               {"light", FieldType::u32},
                               {"direct", FieldType::u32},
                               {"source", FieldType::u32}},
                              reserved);
    const auto count = builder.counter(
        {.key = "indirect.footprints_shown", .label = "Footprints shown", .growth_of = shown});
    builder.pass("show footprints")
        .reads("Photons", photons.records)
        .writes("AllShown", shown)
        .counts("StoredCount", photons.count)
        .counts("ShownCount", count)
        .execute_sliced(
            static_cast<std::int64_t>(most),
            [=](PassContext& context, Slice slice) {
                const auto& program = context.use({{"methods/ldm-indirect/tracing/show_photons.comp"}});
                program.set(ShowPhotons{static_cast<unsigned>(context.capacity(photons.records)),
                                        static_cast<unsigned>(context.capacity(shown))});
                gl::dispatch_items(program, slice.begin, slice.end);
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
                "the lights' images.",
         .explains = true},
        {.key = "indirect.footprints",
         .label = "Footprints",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc = "The stored photons with their differentials, before splatting scales and limits them. "
                "map and side: the direction that they came along. flux: W. path_length: m from the light.",
         .categories = {side_categories(),
                        {"direct",
                         {{0, "by way of a surface", tints::sky},
                          {1, "from the light itself", tints::yellow}}}},
         .explains = true}};
}

}  // namespace ir::methods::ldm_indirect
