#include "renderers/methods/ldm-ao/passes.h"

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

const Categories what_was_hit{"hit",
                              {{-1, "below the surface, not queried", tints::dark},
                               {0, "miss", tints::sky},
                               {1, "hit", tints::orange}}};

const Categories what_an_entry_is{"role",
                                  {{0, "none", tints::grey},
                                   {1, "the point's own", tints::green},
                                   {2, "hit along the direction", tints::orange},
                                   {3, "hit against it", tints::sky},
                                   {4, "passed over by its slopes", tints::purple}}};

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
    pass.writes("Hits", explanation.hits.elements).writes("Rays", explanation.rays.elements);
    pass.counts("HitCount", explanation.hits.count).counts("RayCount", explanation.rays.count);
    pass.execute([=](graph::PassContext& context) {
        gl::ProgramSource source{{"methods/ldm-ao/explain_hits.comp"}};
        source.defines = ldm::defines_of(context, *maps);
        source.defines["REGION_WORDS"] = region_words(*maps);
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
    pass.writes("Entries", explanation.entries.elements)
        .writes("Walk", explanation.walk.elements)
        .writes("Texels", explanation.texel.elements)
        .writes("Nodes", explanation.nodes.elements);
    pass.counts("EntryCount", explanation.entries.count)
        .counts("WalkCount", explanation.walk.count)
        .counts("TexelCount", explanation.texel.count)
        .counts("NodeCount", explanation.nodes.count);
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

}  // namespace

std::string region_words(const ldm::Maps& maps) {
    int words = 0;
    for (const auto& field : ldm::region_fields(maps)) words += field.count;
    return std::to_string(words) + "u";
}

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
         .categories = {what_was_hit, {"side", {ldm::against_map, ldm::along_map}}},
         .when_empty = no_surface,
         .explains = true},
        {.key = "ldm.explain.entries",
         .label = "Entries under the pixel",
         .kind = OutputKind::point_set,
         .semantic = Semantic::position,
         .unit = "m",
         .doc =
             "All depths at the texel where the map chosen is queried for the pixel's point. depth: metres "
             "along the map's direction, from the point. layer: 0 is the first along that direction.",
         .categories = {what_an_entry_is},
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
             "The outline of the texel where the map chosen is queried, as high as the point's surface at its "
             "middle.",
         .when_empty = no_surface,
         .explains = true},
        {.key = "ldm.explain.nodes",
         .label = "Surfaces of nodes",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc =
             "Of each entry under the pixel the texel's outline, tilted as the node's slopes say that its "
             "surface lies, but not steeper than 4 texels of depth a texel. slope_u, slope_v: depth gained along "
             "the texel's sides, in m per m. Nodes without slopes lie flat.",
         .categories = {what_an_entry_is},
         .when_empty = no_surface,
         .explains = true},
    };
}

Explanation declare_explanation(graph::GraphBuilder& builder, const ldm::Maps& maps, ldm::MapRange chosen) {
    const auto maps_chosen = static_cast<std::uint64_t>(chosen.count);
    const auto declare = [&](const std::string& output, std::vector<graph::Field> fields,
                             std::uint64_t elements, const std::string& counter, const std::string& label) {
        return builder.explanation("ldm.explain." + output,
                                   {.fields = std::move(fields), .elements = elements},
                                   {.key = "ldm.explain." + counter, .label = label});
    };
    auto hit_fields = ldm::region_fields(maps);
    for (const char* name : {"hit", "distance", "contribution"}) hit_fields.push_back({name, FieldType::f32});
    hit_fields.push_back({"own_found", FieldType::u32});
    return {
        .hits = declare("hits", hit_fields, 2 * maps.directions.size(), "hit_count", "Directions explained"),
        .rays = declare("rays", record_fields<QueriedRay>(), maps.directions.size(), "ray_count",
                        "Rays explained"),
        .entries = declare("entries", record_fields<Entry>(), maps_chosen * expected_entries, "entry_count",
                           "Entries under the pixel"),
        .walk = declare("walk", record_fields<WalkLine>(), maps_chosen * expected_entries, "walk_count",
                        "Lines of the walk"),
        .texel = declare("texel", record_fields<Texel>(), maps_chosen, "texel_count", "Texels queried"),
        .nodes = declare("nodes", record_fields<NodeOutline>(), maps_chosen * expected_entries, "node_count",
                         "Nodes under the pixel")};
}

void explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
             graph::BufferRef directions, ldm::MapRange chosen, const Explanation& explanation) {
    explain_hits(builder, gbuffer, maps, batch, directions, explanation);
    explain_entries(builder, gbuffer, maps, batch, chosen, explanation);
}

}  // namespace ir::methods::ldm_ao
