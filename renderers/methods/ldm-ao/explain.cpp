#include "renderers/methods/ldm-ao/passes.h"

#include "renderers/core/record.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/ldm/map_views.h"
#include "renderers/passes/ldm/walk.h"
#include "shaders/methods/ldm-ao/explain_hits.comp.h"

namespace ir::methods::ldm_ao {
namespace {

namespace ldm = passes::ldm;
using graph::FieldType;

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
    unsigned map_among_all, map_of_batch;
    IR_FIELDS(explained, map_among_all, map_of_batch)
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
    explanation.walk.written_by(pass);
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
    std::vector<OutputDescription> outputs{
        {.key = "ldm.explain.hits",
         .label = "Hits by direction",
         .kind = OutputKind::sphere_values,
         .doc =
             "What each of the 2N directions finds from the pixel's point. distance: metres to the hit, or to "
             "the largest distance or the scene's end. contribution: what the direction adds to the pixel's "
             "accessibility of this frame. own_found: whether the point's own entry was in the map.",
         .categories = {ldm::what_was_hit(), ldm::yes_or_no("own_found", "not found", "found")},
         .when_empty = no_surface,
         .explains = true},
        {.key = "ldm.explain.rays",
         .label = "Rays of the pixel",
         .kind = OutputKind::line_set,
         .unit = "m",
         .doc =
             "One line per map: from the pixel's point along the direction above its surface to what it "
             "hits, or to the largest distance or the scene's end. Lines below the surface have no length.",
         .categories = {ldm::what_was_hit(), {"side", {ldm::against_map, ldm::along_map}}},
         .when_empty = no_surface,
         .explains = true}};
    const auto walk = ldm::walk_outputs({.point = "the pixel's point",
                                         .map = "the map chosen",
                                         .ends = "the largest distance or the scene's end",
                                         .when_empty = no_surface});
    outputs.insert(outputs.end(), walk.begin(), walk.end());
    return outputs;
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
        .walk = ldm::declare_walk_views(builder, maps_chosen)};
}

void explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
             graph::BufferRef directions, ldm::MapRange chosen, const Explanation& explanation) {
    explain_hits(builder, gbuffer, maps, batch, directions, explanation);
    explain_entries(builder, gbuffer, maps, batch, chosen, explanation);
}

}  // namespace ir::methods::ldm_ao
