#include "renderers/methods/ambient-occlusion-volumes/parameters.h"

#include <algorithm>

#include "renderers/passes/direct/lit.h"

namespace ir::methods::ambient_occlusion_volumes {
namespace {

void add_additive(ParameterTable<Parameters>& table) {
    const Condition additive{"visibility", {false}};
    table
        .add(&Parameters::sides,
             {.key = "sides",
              .label = "Sides",
              .doc = "On which sides of its triangle a volume stands, without visibility.",
              .citation = "McGuire10",
              .choices = {{"front", "Front",
                           "Where the winding's normal points, as published: of closed bodies the far side "
                           "does not count as well. Single sheets do not occlude what is behind them."},
                          {"both", "Both", "All triangles are sheets, as in the reference."}},
              .active_when = additive})
        .add(&Parameters::compensation,
             {.key = "compensation",
              .label = "Compensation",
              .doc = "How accessibility is made of the sum of all triangles' occlusion, which counts what "
                     "lies behind each other as often as it is there.",
              .citation = "McGuire10",
              .choices = {{"none", "None", "1 − Σ, not below 0."},
                          {"independent", "Independent occluders",
                           "e^−Σ: what many small occluders leave open that lie anywhere. Too dark no more "
                           "where much overlaps, but too bright behind what does not."},
                          {"measured", "Measured",
                           "A map from the sum to what rays find open there on average, over the pixels of "
                           "ten scenes; another for each fall-off and choice of sides. It stands in for the "
                           "paper's compensation map."}},
              .active_when = additive});
}

}  // namespace

ParameterTable<Parameters> parameter_table() {
    using passes::bounce::Effects;
    ParameterTable<Parameters> table;
    table.add(&Parameters::visibility,
              {.key = "visibility",
               .label = "Visibility",
               .doc = "By bounced z-buffer: each sample of a pixel takes the nearest triangle along one "
                      "direction of its own. Off: the form factors of all triangles add up, whatever is in "
                      "between, as published in 2010.",
               .citation = "Nalbach15 §3"});
    table.include(
        &Parameters::transport,
        transport_parameters({.paths = {"ao"}, .keys = {"max_distance", "falloff", "normal_maps"}}));
    table.include(&Parameters::directions,
                  passes::bounce::direction_parameters({"visibility", {true}}, Effects::ambient_occlusion));
    add_additive(table);
    table.include(&Parameters::reconstruction, passes::bounce::reconstruction_parameters(
                                                   {"visibility", {true}}, Effects::ambient_occlusion));
    table
        .add(&Parameters::culling,
             {.key = "culling",
              .label = "Cull volumes",
              .doc = "Leaves out volumes in which nothing lies that the picture shows, tile by tile.",
              .citation = "Nalbach15 §4.3",
              .effect = Effect::cost})
        .add(&Parameters::ambient, passes::ambient_parameter())
        .include(&Parameters::light, passes::light_parameters());
    return table;
}

bool both_sides(const Parameters& parameters) {
    return parameters.visibility || parameters.sides == Sides::both;
}

float reach_of(const Parameters& parameters, const scene::World& world) {
    return parameters.transport.max_distance > 0 ? parameters.transport.max_distance
                                                 : std::max(2 * world.bounds.radius(), 1e-6f);
}

}  // namespace ir::methods::ambient_occlusion_volumes
