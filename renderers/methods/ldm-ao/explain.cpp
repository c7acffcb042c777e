#include "renderers/methods/ldm-ao/explain.h"

#include "renderers/core/record.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/ldm/map_views.h"
#include "shaders/methods/ldm-ao/explain_entries.comp.h"
#include "shaders/methods/ldm-ao/explain_hits.comp.h"

namespace ir::methods::ldm_ao {
namespace {

namespace ldm = passes::ldm;
using graph::FieldType;

/// Entries that are reserved for each map chosen, and lines of the walk.
constexpr std::uint64_t expected_entries = 64;

const std::string no_surface = "the pixel shows no surface";

const Categories what_was_hit{
    "hit",
    {{-1, "below the surface, not asked", tints::dark}, {0, "miss", tints::sky}, {1, "hit", tints::orange}}};

Categories yes_or_no(const std::string& field, const std::string& no, const std::string& yes) {
    return {field, {{0, no, tints::grey}, {1, yes, tints::green}}};
}

/// Constants of explained.glsl.
struct Explained {
    glm::ivec2 pixel;
    glm::vec3 scene_min, scene_max;
    IR_FIELDS(pixel, scene_min, scene_max)
};

/// Constants of explain_hits.comp.
struct ExplainHits {
    Explained explained;
    unsigned first_frame, map_count, all_maps;
    IR_FIELDS(explained, first_frame, map_count, all_maps)
};

/// Constants of explain_entries.comp.
struct ExplainEntries {
    Explained explained;
    unsigned frame_index, map;
    IR_FIELDS(explained, frame_index, map)
};

Explained explained(const graph::FrameInputs& inputs) {
    return {inputs.picked_pixel(), inputs.world->bounds.min, inputs.world->bounds.max};
}

void explain_hits(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
                  graph::BufferRef directions, const Explanation& explanation) {
    auto pass = builder.pass("explain hits" + maps->batch_name(batch));
    ldm::reads_maps(pass, *maps);
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal).reads("Regions", directions);
    pass.writes("Hits", explanation.hits).writes("Rays", explanation.rays);
    pass.counts("HitCount", explanation.hit_count).counts("RayCount", explanation.ray_count);
    pass.execute([=](graph::PassContext& context) {
        gl::ProgramSource source{{"methods/ldm-ao/explain_hits.comp"}};
        source.defines = ldm::defines_of(context, *maps);
        int words = 0;
        for (const auto& field : ldm::region_fields(*maps)) words += field.count;
        source.defines["REGION_WORDS"] = std::to_string(words) + "u";
        const auto& program = context.use(source);
        program.set(ExplainHits{.explained = explained(context.inputs()),
                                .first_frame = static_cast<unsigned>(maps->first_map(batch)),
                                .map_count = static_cast<unsigned>(maps->batch_maps(batch)),
                                .all_maps = static_cast<unsigned>(maps->layout.maps)});
        program.dispatch(maps->batch_maps(batch));
    });
}

void explain_entries(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps,
                     int batch, ldm::MapRange chosen, const Explanation& explanation) {
    const auto range = chosen.in_batch(*maps, batch);
    if (range.count == 0) return;
    auto pass = builder.pass("explain entries" + maps->batch_name(batch));
    ldm::reads_maps(pass, *maps);
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal);
    pass.writes("Entries", explanation.entries)
        .writes("Walk", explanation.walk)
        .writes("Texels", explanation.texel);
    pass.counts("EntryCount", explanation.entry_count)
        .counts("WalkCount", explanation.walk_count)
        .counts("TexelCount", explanation.texel_count);
    pass.execute([=](graph::PassContext& context) {
        gl::ProgramSource source{{"methods/ldm-ao/explain_entries.comp"}};
        source.defines = ldm::defines_of(context, *maps);
        const auto& program = context.use(source);
        // One after another, so that elements come in the order of the maps.
        for (int map = range.first; map < range.first + range.count; ++map) {
            program.set(ExplainEntries{explained(context.inputs()), static_cast<unsigned>(map),
                                       static_cast<unsigned>(map - maps->first_map(batch))});
            program.dispatch(1);
            context.barrier();
        }
    });
}

graph::CounterRef count_of(graph::GraphBuilder& builder, const std::string& what, const std::string& label,
                           graph::BufferRef buffer) {
    return builder.counter({.key = "ldm.explain." + what + "_count",
                            .label = label,
                            .doc = "0 while no pixel is picked, and where the pixel shows no surface.",
                            .growth_of = buffer});
}

}  // namespace

std::vector<OutputDescription> explanation_outputs() {
    return {
        {.key = "ldm.explain.hits",
         .label = "Hits by direction",
         .kind = OutputKind::sphere_values,
         .doc =
             "What each of the 2N directions finds from the pixel's point. distance: metres to the hit, or to "
             "the largest distance or the scene's end. contribution: what the direction adds to the pixel's "
             "accessibility of this frame. own_found: whether the point's own entry was in the map.",
         .categories = {what_was_hit, yes_or_no("own_found", "not found", "found")},
         .when_empty = no_surface,
         .explains = true},
        {.key = "ldm.explain.rays",
         .label = "Rays of the pixel",
         .kind = OutputKind::line_set,
         .unit = "m",
         .doc =
             "One line per map: from the pixel's point along the direction above its surface to what it "
             "hits, or to the largest distance or the scene's end. Lines below the surface have no length.",
         .categories = {what_was_hit,
                        {"side",
                         {{-1, "against the map's direction", tints::orange},
                          {1, "along the map's direction", tints::sky}}}},
         .when_empty = no_surface,
         .explains = true},
        {.key = "ldm.explain.entries",
         .label = "Entries under the pixel",
         .kind = OutputKind::point_set,
         .semantic = Semantic::position,
         .unit = "m",
         .doc = "All depths at the texel that the map chosen is asked for the pixel's point. depth: metres "
                "along the map's direction, from the point. layer: 0 is the first along that direction.",
         .categories = {{"role",
                         {{0, "none", tints::grey},
                          {1, "the point's own", tints::green},
                          {2, "hit along the direction", tints::orange},
                          {3, "hit against it", tints::sky}}}},
         .when_empty = no_surface,
         .explains = true},
        {.key = "ldm.explain.walk",
         .label = "Walk through the map",
         .kind = OutputKind::line_set,
         .unit = "m",
         .doc =
             "From the pixel's point along and against the direction of the map chosen to what is found "
             "there, or to the largest distance or the scene's end; hit says which. above: whether the "
             "direction is above the surface, and counts. Then from entry to entry of the texel, up to the "
             "one where a search from the front ends; step counts them.",
         .categories = {{"role",
                         {{0, "along the direction", tints::orange},
                          {1, "against it", tints::sky},
                          {2, "from entry to entry", tints::purple}}},
                        what_was_hit,
                        yes_or_no("above", "below the surface", "above, counts")},
         .when_empty = no_surface,
         .explains = true},
        {.key = "ldm.explain.texel",
         .label = "Queried texel",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc =
             "The outline of the texel that the map chosen is asked, where the point's surface crosses its "
             "middle.",
         .when_empty = no_surface,
         .explains = true},
    };
}

Explanation declare_explanation(graph::GraphBuilder& builder, const ldm::Maps& maps, ldm::MapRange chosen) {
    const auto maps_chosen = static_cast<std::uint64_t>(chosen.count);
    // Growable, so that counters tell how many elements are in use.
    Explanation e;
    auto hit_fields = ldm::region_fields(maps);
    for (const char* name : {"hit", "distance", "contribution"}) hit_fields.push_back({name, FieldType::f32});
    hit_fields.push_back({"own_found", FieldType::u32});
    e.hits = builder.output("ldm.explain.hits",
                            {.fields = hit_fields, .elements = 2 * maps.directions.size(), .growable = true});
    e.rays = builder.output(
        "ldm.explain.rays",
        {.fields = record_fields<AskedRay>(), .elements = maps.directions.size(), .growable = true});
    e.entries = builder.output(
        "ldm.explain.entries",
        {.fields = record_fields<Entry>(), .elements = maps_chosen * expected_entries, .growable = true});
    e.walk = builder.output(
        "ldm.explain.walk",
        {.fields = record_fields<WalkLine>(), .elements = maps_chosen * expected_entries, .growable = true});
    e.texel = builder.output("ldm.explain.texel",
                             {.fields = record_fields<Texel>(), .elements = maps_chosen, .growable = true});
    e.hit_count = count_of(builder, "hit", "Directions explained", e.hits);
    e.ray_count = count_of(builder, "ray", "Rays explained", e.rays);
    e.entry_count = count_of(builder, "entry", "Entries under the pixel", e.entries);
    e.walk_count = count_of(builder, "walk", "Lines of the walk", e.walk);
    e.texel_count = count_of(builder, "texel", "Texels asked", e.texel);
    return e;
}

void explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
             graph::BufferRef directions, ldm::MapRange chosen, const Explanation& explanation) {
    explain_hits(builder, gbuffer, maps, batch, directions, explanation);
    explain_entries(builder, gbuffer, maps, batch, chosen, explanation);
}

}  // namespace ir::methods::ldm_ao
