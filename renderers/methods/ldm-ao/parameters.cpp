#include "renderers/methods/ldm-ao/parameters.h"

#include "renderers/passes/direct/lit.h"

namespace ir::methods::ldm_ao {
namespace {

void add_exact(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::exact,
             {.key = "exact",
              .label = "Exact rays",
              .doc =
                  "Takes hits from ray tracing instead of the maps, to tell the causes of error apart: what "
                  "is left with all hits exact is due to the directions, what exact hits nearby take away "
                  "to the self-hit rule, and the rest to the texels.",
              .choices = {{"none", "None", "All hits come from the maps: the method itself."},
                          {"near", "Near hits",
                           "Hits up to a few texels away are exact, those beyond come "
                           "from the maps."},
                          {"all", "All hits", "The maps are not queried."}}})
        .add(&Parameters::exact_texels,
             {.key = "exact_texels",
              .label = "Reach of exact rays",
              .doc = "Hits up to so far away are exact, in texels of the map queried.",
              .unit = "texels",
              .hard = {0, 4096},
              .soft = {0, 16},
              .active_when = {"exact", {std::string("near")}}});
}

}  // namespace

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    table.include(&Parameters::maps, passes::ldm::map_parameters(passes::ldm::Asks::any));
    table.include(
        &Parameters::transport,
        transport_parameters({.paths = {"ao"}, .keys = {"max_distance", "falloff", "normal_maps"}}));
    table.include(&Parameters::maps, passes::ldm::self_hit_parameters());
    add_exact(table);
    table
        .add(&Parameters::progressive,
             {.key = "progressive",
              .label = "Progressive",
              .doc = "Turns the set of directions at random in every frame and averages over frames. Turning "
                     "adds noise; without it frames are equal.",
              .citation = "Aalund15 §6"})
        .add(&Parameters::ambient, passes::ambient_parameter())
        .include(&Parameters::light, passes::light_parameters());
    return table;
}

}  // namespace ir::methods::ldm_ao
