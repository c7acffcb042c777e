#include "renderers/methods/ssdo/parameters.h"

namespace ir::methods::ssdo {
namespace {

const Condition published{"estimator", {std::string("published")}};

void add_estimator(ParameterTable<Parameters>& table) {
    table
        .add(
            &Parameters::estimator,
            {.key = "estimator",
             .label = "Estimator",
             .doc = "How much light an occluder sends for each sample that found it.",
             .citation = "Ritschel09 §3.2",
             .choices = {{"density", "By density",
                          "Divided by the density with which samples find the occluder's pixel: converges to "
                          "the light from all that the picture shows within the radius, whatever is in "
                          "between."},
                         {"published", "Published",
                          "Each stands for the area A_s = π r² / N, its distance no less than the minimum "
                          "distance: converges to something else, which depends on the view."}}})
        .add(&Parameters::strength,
             {.key = "strength",
              .label = "Strength",
              .doc = "Factor of the published area A_s, by which people adjust the colour bleeding.",
              .citation = "Ritschel09 §3.2",
              .hard = {0, 1e3},
              .soft = {0, 4},
              .active_when = published})
        .add(
            &Parameters::min_distance,
            {.key = "min_distance",
             .label = "Minimum distance",
             .doc = "Distances below it count as it in the published estimator, as a fraction of the radius. "
                    "The paper clamps to 1 of a unit that it does not name: if it is the radius, pictures "
                    "are far too dark.",
             .citation = "Ritschel09 §3.2",
             .hard = {1e-4, 1},
             .soft = {0.05, 1},
             .active_when = published});
}

}  // namespace

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    table.add(
        &Parameters::samples,
        {.key = "samples",
         .label = "Samples",
         .doc = "Directions over the hemisphere of each pixel, with one step of random length along each, "
                "up to the step radius.",
         .citation = "Ritschel09 §3.1",
         .hard = {1, 4096},
         .soft = {4, 64},
         .coarse = std::int64_t{8}});
    table.add(
        &Parameters::layers,
        {.key = "layers",
         .label = "Layers",
         .doc = "Surfaces along each pixel's view ray that occlude and send, by depth peeling. 1: those that "
                "the picture shows, as thick as can be. Further ones end them: a step that ends behind a "
                "body is open, and sides that are turned away from the camera send their direct light, too. "
                "Each layer costs another G-buffer with its direct light.",
         .citation = "Ritschel09 §4",
         .hard = {1, 8},
         .soft = {1, 4},
         .coarse = std::int64_t{1}});
    table.include(
        &Parameters::transport,
        transport_parameters({.paths = {"direct", "indirect", "full"},
                              .keys = {"max_distance", "materials", "normal_maps", "environment_light"}}));
    table.add(
        &Parameters::environment_by,
        {.key = "environment_by",
         .label = "Light of the environment",
         .doc = "How its direct light is found.",
         .citation = "Ritschel09 §3.1",
         .choices = {{"samples", "Samples", "Rays, as in all methods of light: walls keep it out."},
                     {"occlusion", "Directional occlusion",
                      "As published: directions along which the step finds no occluder let it in. Nothing "
                      "beyond the step keeps it out, so closed rooms are lit as if they were open."}},
         .exact = {"samples"},
         .active_when = {"environment_light", {true}},
         .since_version = 2,
         .value_in_older_projects = std::string("occlusion")});
    table.add(
        &Parameters::step_radius,
        {.key = "step_radius",
         .label = "Step radius",
         .doc = "How long steps are at most; never longer than the maximum distance. 0: as long as that, or "
                "without one as the diagonal of the scene's bounds, where few samples find what is near. "
                "Therefore the default of max_distance is not that of other methods.",
         .unit = "m",
         .citation = "Ritschel09 §3.1",
         .hard = {0, 1e9},
         .soft = {0, 4}});
    add_estimator(table);
    table.add(
        &Parameters::turning,
        {.key = "turning",
         .label = "Turning",
         .doc = "How directions and steps are shifted from pixel to pixel, so that what few samples miss "
                "becomes a pattern that the blur takes away. The same in every frame.",
         .citation = "Ritschel09 §3.1",
         .choices = {{"none", "None", "All pixels step alike: banding in place of noise."},
                     {"pattern", "4×4 pattern", "Sixteen shifts that repeat."},
                     {"hash", "Hash", "Another shift for each pixel, by the seed."}}});
    table.include(&Parameters::blur, passes::blur_parameters());
    table.include(&Parameters::light, passes::light_parameters());
    return table;
}

}  // namespace ir::methods::ssdo
