#include "renderers/methods/ldm-indirect/tracing/emission.h"

#include "renderers/gl/dispatch_items.h"

namespace ir::methods::ldm_indirect {
namespace {

using graph::Field;
using graph::FieldType;

std::vector<Field> primary_fields() {
    return {{"position", FieldType::f32, 3},    {"source", FieldType::u32},
            {"axis_u", FieldType::f32, 3},      {"light", FieldType::u32},
            {"axis_v", FieldType::f32, 3},      {"path_length"},
            {"turn_u", FieldType::f32, 3},      {"cosine_sum"},
            {"turn_v", FieldType::f32, 3},      {"fate", FieldType::u32},
            {"direction", FieldType::f32, 3},   {"reached"},
            {"normal", FieldType::f32, 3},      {"solid_angle"},
            {"shading", FieldType::f32, 3},     {"unused0"},
            {"emitted", FieldType::f32, 3},     {"unused1"},
            {"reflectance", FieldType::f32, 3}, {"unused2"}};
}

}  // namespace

Primaries emit_photons(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                       const passes::Rsm& images, const passes::ldm::Maps& maps) {
    Primaries primaries;
    primaries.count = static_cast<std::uint64_t>(images.layers) *
                      static_cast<std::uint64_t>(images.resolution) *
                      static_cast<std::uint64_t>(images.resolution);
    primaries.records = builder.buffer(
        {.text = {.key = "indirect.primary_photons",
                  .label = "Primary photons, all",
                  .doc = "A photon for each texel of the lights' images, up to its first surface. Axes and "
                         "turns are half of the differentials of position and direction. fate: 0 "
                         "nothing was seen or no light shines there, 1 splits, 2 its footprint is "
                         "degenerate."},
         .fields = primary_fields(),
         .elements = primaries.count});
    primaries.shares = builder.buffer(
        {.text = {.key = "indirect.shares",
                  .label = "Where split photons go",
                  .doc =
                      "Of each primary photon: parts of the flux that it reflects, and numbers of photons, "
                      "by cause (see indirect.energy, leg 1)."},
         .fields = {{"part", FieldType::f32, causes}, {"photons", FieldType::u32, causes}},
         .elements = primaries.count,
         .cleared = true});
    auto pass = builder.pass("emit photons");
    passes::reads_rsm(pass, images, scene);
    pass.reads(images.geometric_normal, maps.frame_buffer)
        .writes("Primaries", primaries.records)
        .writes(primaries.shares)
        .execute_sliced(
            static_cast<std::int64_t>(primaries.count),
            [=, map_count = maps.layout.maps](graph::PassContext& context, graph::Slice slice) {
                const auto& program = context.use({{"methods/ldm-indirect/tracing/emit.comp"}});
                program.set("views_drawn", static_cast<unsigned>(images.views_drawn));
                program.set("map_count", static_cast<unsigned>(map_count));
                gl::dispatch_items(program, slice.begin, slice.end);
            },
            4096);
    return primaries;
}

}  // namespace ir::methods::ldm_indirect
