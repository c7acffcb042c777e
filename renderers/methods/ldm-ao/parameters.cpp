#include "renderers/methods/ldm-ao/parameters.h"

#include "renderers/passes/direct/lit.h"

namespace ir::methods::ldm_ao {
namespace {

void add_nodes(ParameterTable<Parameters>& table) {
    table.add(
        &Parameters::nodes,
        {.key = "nodes",
         .label = "Nodes",
         .doc = "What a map holds of each surface. Slopes need a max_distance, the rule tangent-plane and "
                "exact=none or selected; else nodes are plain.",
         .citation = "Aalund15 §3.1",
         .choices = {{"plain", "Depths", "The depth at the texel's centre, as published: 2 bytes."},
                     {"sloped", "Depths and slopes",
                      "Also the slopes of the surface there, 8 bits each: 4 bytes. A hit must lie before "
                      "the point by its depth at the texel's centre, and by its slopes at the point's own "
                      "place. Of the slope tolerance 0.3 are enough then."}},
         .on_change = OnChange::reallocate,
         .active_when = passes::ldm::keeps_slopes(),
         .since_version = 2,
         .value_in_older_projects = std::string("plain")});
}

void add_exact(ParameterTable<Parameters>& table) {
    table
        .add(
            &Parameters::exact,
            {.key = "exact",
             .label = "Exact rays",
             .doc =
                 "Takes hits from ray tracing instead of the maps, to tell the causes of error apart: what "
                 "is left with all hits exact is due to the directions, what exact hits nearby take away "
                 "to the self-hit rule, and the rest to the texels. 'selected' makes the picture better: only "
                 "pixels that need them take exact hits.",
             .choices =
                 {{"none", "None", "All hits come from the maps: the method itself."},
                  {"near", "Near hits",
                   "Hits up to a few texels away are exact, those beyond come from the maps."},
                  {"all", "All hits", "The maps are not queried."},
                  {"selected", "All hits of some pixels",
                   "Of pixels that have much within a texel or two, which 16 short rays find out. The others "
                   "take all hits from the maps, and so do the sky's light and explanations."}},
             .exact = {"near", "all"}})
        .add(&Parameters::exact_texels,
             {.key = "exact_texels",
              .label = "Reach of exact rays",
              .doc = "Hits up to so far away are exact, in texels of the map queried.",
              .unit = "texels",
              .hard = {0, 4096},
              .soft = {0, 16},
              .active_when = {"exact", {std::string("near")}}});
}

ParameterText ambient_text() {
    auto text = passes::ambient_parameter();
    text.active_when = {"ambient_source", {std::string("constant")}};
    return text;
}

}  // namespace

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    table.include(&Parameters::maps, passes::ldm::map_parameters({.outermost = true, .sloped = true}));
    table.include(
        &Parameters::transport,
        transport_parameters({.paths = {"ao"}, .keys = {"max_distance", "falloff", "normal_maps"}}));
    table.include(&Parameters::maps, passes::ldm::self_hit_parameters());
    add_nodes(table);
    add_exact(table);
    table
        .add(&Parameters::progressive,
             {.key = "progressive",
              .label = "Progressive",
              .doc = "Turns the set of directions at random in every frame and averages over frames. Turning "
                     "adds noise; without it frames are equal.",
              .citation = "Aalund15 §6"})
        .add(
            &Parameters::orientation,
            {.key = "orientation",
             .label = "Orientation",
             .doc =
                 "How the set of directions lies. Edges of floors, walls and ledges lie level, as its collars "
                 "do, and so are met by many directions at once.",
             .citation = "Aalund15 §3.2",
             .choices =
                 {{"level", "Level", "The pole of the partition is +Y, as published."},
                  {"tilted", "Tilted",
                   "The set is turned, so that collars are parallel to no axis: less error in rooms, but "
                   "views of directions have no bounds of regions."}},
             .on_change = OnChange::reallocate,
             .active_when = {"progressive", {false}}})
        .add(&Parameters::ambient_source,
             {.key = "ambient_source",
              .label = "Light from outside",
              .doc = "What shines in the output “lit” where directions are open.",
              .citation = "Aalund15 fig. 11",
              .choices =
                  {{"constant", "Constant", "The same radiance from all directions."},
                   {"environment", "Environment",
                    "The scene's environment: of each direction its mean over the direction's region."}}})
        .add(&Parameters::ambient, ambient_text())
        .include(&Parameters::light, passes::light_parameters());
    return table;
}

}  // namespace ir::methods::ldm_ao
