#include "renderers/methods/deep-screen-space/parameters.h"

#include "renderers/passes/direct/lit.h"

namespace ir::methods::deep_screen_space {

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    table.add(
        &Parameters::visibility,
        {.key = "visibility",
         .label = "Visibility",
         .doc = "By bounced z-buffer: each sample of a pixel takes the nearest surfel along one direction of "
                "its own. Off: all surfels add up, whatever is in between, as published in 2014.",
         .citation = "Nalbach15 §3"});
    table.include(&Parameters::transport,
                  transport_parameters({.paths = {"ao", "indirect", "full"},
                                        .keys = {"max_distance", "falloff", "materials", "normal_maps",
                                                 "environment_light"}}));
    table.include(&Parameters::directions, passes::bounce::direction_parameters(
                                               {"visibility", {true}}, passes::bounce::Effects::light));
    add_surfel_parameters(table);
    add_splatting_parameters(table);
    table.include(&Parameters::reconstruction, passes::bounce::reconstruction_parameters(
                                                   {"visibility", {true}}, passes::bounce::Effects::light));
    table.include(&Parameters::reprojection, passes::reprojection_parameters());
    table.add(&Parameters::ambient, passes::ambient_parameter());
    return table;
}

}  // namespace ir::methods::deep_screen_space
