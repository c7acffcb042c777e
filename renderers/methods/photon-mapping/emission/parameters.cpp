#include "renderers/methods/photon-mapping/emission/weights.h"

namespace ir::methods::photon_mapping {
namespace {

const Condition with_rsm{"first_hit", {std::string("rsm")}};
const Condition by_importance{"emission", {std::string("importance")}};
const Condition with_weights = when_weighted();

void add_counts(ParameterTable<Parameters>& table) {
    table.add(&Parameters::photons,
              {.key = "photons",
               .label = "Photons",
               .doc = "Photons that all lights together emit in a frame, before any is absorbed.",
               .citation = "Smal19 §4.2",
               .hard = {1, 8'000'000},
               .soft = {10'000, 1'000'000},
               .on_change = OnChange::reallocate,
               .coarse = std::int64_t{20'000}});
    table.include(&Parameters::transport,
                  transport_parameters({.paths = {"direct", "indirect", "full"},
                                        .keys = {"min_bounces", "max_bounces", "max_distance", "materials",
                                                 "normal_maps", "environment_light"}}));
}

void add_rsm(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::first_hit,
             {.key = "first_hit",
              .label = "First hit",
              .doc = "How the surfaces are found that point, spot and directional lights see, where photons "
                     "start. From rectangles, disks, emissive surfaces and the environment, and from lights "
                     "beyond 64 maps, rays are traced in any case.",
              .citation = "Smal19 §5",
              .choices = {{"rsm", "Reflective shadow map",
                           "What each light sees is drawn once; photons start where its texels are."},
                          {"traced", "Traced", "A ray from the light for each point, by its intensity."}},
              .exact = {"traced"},
              .on_change = OnChange::reallocate})
        .add(&Parameters::rsm_resolution,
             {.key = "rsm_resolution",
              .label = "RSM resolution",
              .doc = "Texels along each side of a reflective shadow map. A point light has six maps.",
              .unit = "texels",
              .citation = "Smal19 §5.1",
              .choices = {{"64", "64", ""},
                          {"128", "128", ""},
                          {"256", "256", ""},
                          {"512", "512", ""},
                          {"1024", "1024", ""}},
              .on_change = OnChange::reallocate,
              .active_when = with_rsm})
        .add(&Parameters::depth_prepass,
             {.key = "depth_prepass",
              .label = "Depth first",
              .doc = "Draws a shadow map at the RSM's resolution first, so that only what the light sees is "
                     "shaded.",
              .citation = "Smal19 §5.1",
              .effect = Effect::cost,
              .on_change = OnChange::reallocate,
              .active_when = with_rsm});
}

void add_emission(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::emission,
             {.key = "emission",
              .label = "Emission",
              .doc = "Where in the maps the emission set's points go.",
              .citation = "Smal19 §5.3",
              .choices = {{"importance", "Importance",
                           "Warped by the Haar pyramid of the map of emission probabilities."},
                          {"uniform", "Uniform", "As they are: evenly over the map."}},
              .active_when = with_rsm})
        .add(&Parameters::photon_near,
             {.key = "photon_near",
              .label = "Photon near plane",
              .doc = "Surfaces closer to the light than this start no photons; their light is missing. For "
                     "directional lights from the near plane of the map, for those and the environment where "
                     "rays are traced from the box about the scene.",
              .unit = "m",
              .citation = "Smal19 §5.2",
              .hard = {0, 1e9},
              .soft = {0, 2}})
        .add(&Parameters::photon_far,
             {.key = "photon_far",
              .label = "Photon far plane",
              .doc = "Surfaces farther from the light than this start no photons; their light is missing. 0 "
                     "means that there is no limit.",
              .unit = "m",
              .citation = "Smal19 §5.2",
              .hard = {0, 1e9},
              .soft = {0, 10}})
        .add(&Parameters::power_scaling,
             {.key = "power_scaling",
              .label = "Power scaling",
              .doc = "How the power of a point makes up for where it was put.",
              .citation = "Smal19 §5.3.3",
              .choices = {{"exact", "Exact",
                           "The flux through the texel over the expected number of points there: unbiased."},
                          {"printed", "As printed",
                           "(P0/P)(π/4) of the uniform power. Wrong: a cone keeps 0.617 of its flux, and its "
                           "soft edge is lost."}},
              .exact = {"exact"},
              .active_when = by_importance})
        .add(&Parameters::budget,
             {.key = "budget",
              .label = "Budget",
              .doc = "How the photons are divided among the lights and their maps.",
              .citation = "Smal19 §4.2",
              .choices = {{"intensity", "By intensity", "In proportion to the flux of each map."},
                          {"probability", "By probability",
                           "In proportion to flux times mean emission probability: little for maps that see "
                           "little."}},
              .active_when = with_rsm});
}

/// Stability is that of velocity v and place x without counts, at a spring k and a drag d. With the new
/// velocity the step has determinant 1 - d and trace 2 - d - k, so both eigenvalues lie within the unit
/// circle where k < 4 - 2 d; with the old one 1 - d + k and 2 - d, so where k < d.
void add_weights(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::weights,
             {.key = "weights",
              .label = "Weights from visibility",
              .doc =
                  "Whether the maps learn from frame to frame which texels send photons into the view. Each "
                  "frame then has photons of its own, and strata do not count.",
              .citation = "Smal19 §5.4",
              .choices = {{"none", "None", "Maps know the first surface alone."},
                          {"visible", "Visible",
                           "p (1/10 + 9/10 x), with x moved by the new velocity: stable for all springs "
                           "below 4 - 2 drag."},
                          {"printed", "As printed",
                           "1/10 + 9/10 x p, which sends points where nothing is, too, and x is moved by the "
                           "old velocity: stable where the spring is smaller than the drag."}},
              .active_when = by_importance})
        .add(
            &Parameters::seen_by,
            {.key = "seen_by",
             .label = "Seen by",
             .doc = "Which photons count as seen. Kernels that reach into the picture count by their middle.",
             .citation = "Smal19 §5.4.1",
             .choices = {{"frustum", "Frustum",
                          "Those in the camera's frustum, widened by kernels, on surfaces that face it, as "
                          "published: also behind walls."},
                         {"picture", "Picture", "Of these the ones that nothing hides in the picture."}},
             .active_when = with_weights})
        .add(&Parameters::seen_gain,
             {.key = "seen_gain",
              .label = "Gain of a seen photon",
              .doc = "What a photon that is seen adds to the count m of the texel that it came from. Any "
                     "other takes 1 away. Texels whose photons are seen less often than once in 1 + gain get "
                     "no weight.",
              .citation = "Smal19 §5.4.1",
              .hard = {1, 1000},
              .soft = {1, 16},
              .active_when = with_weights})
        .add(&Parameters::weight_force,
             {.key = "weight_force",
              .label = "Force of counts",
              .doc = "C_m times the photons that a texel emits in a frame in the mean: how fast counts move "
                     "the weight x, between 0 and 1. In balance x is force / spring for a texel with a count "
                     "of 1 for each of these photons.",
              .citation = "Smal19 §5.4.2",
              .hard = {0, 100},
              .soft = {0, 1},
              .active_when = with_weights})
        .add(&Parameters::weight_spring,
             {.key = "weight_spring",
              .label = "Spring",
              .doc = "k: how fast weights fall back to 0 where no photon is seen. Weights follow the view in "
                     "about drag / spring frames.",
              .citation = "Smal19 §5.4.2",
              .hard = {0, 2},
              .soft = {0, 1},
              .active_when = with_weights})
        .add(&Parameters::weight_drag,
             {.key = "weight_drag",
              .label = "Drag",
              .doc = "C_d: how fast the velocity of weights dies away. Small values let weights swing.",
              .citation = "Smal19 §5.4.2",
              .hard = {0, 1},
              .soft = {0, 1},
              .active_when = with_weights});
}

void add_sets(ParameterTable<Parameters>& table) {
    table
        .add(
            &Parameters::strata,
            {.key = "strata",
             .label = "Strata",
             .doc = "Frames after which the same photons come again. Each frame of the cycle has an emission "
                    "set of its own; together they are one finer set. 1: the same photons in every frame, "
                    "but for weights from visibility and progressive radii, which renew them.",
             .unit = "frames",
             .citation = "Smal19 §4.2",
             .hard = {1, 512},
             .soft = {1, 16}})
        .add(&Parameters::photons_per_point,
             {.key = "photons_per_point",
              .label = "Photons a point",
              .doc = "Photons that leave each sample point, on paths of their own; as many fewer points.",
              .citation = "Smal19 §5",
              .hard = {1, 64},
              .soft = {1, 8},
              .on_change = OnChange::reallocate})
        .add(&Parameters::reserve,
             {.key = "reserve",
              .label = "Memory reserved",
              .doc =
                  "Fraction of the photons that memory is reserved for at first. It grows where more arrive.",
              .hard = {0, 1},
              .soft = {0.001, 1},
              .effect = Effect::cost,
              .on_change = OnChange::reallocate});
}

}  // namespace

void add_emission_parameters(ParameterTable<Parameters>& table) {
    add_counts(table);
    add_rsm(table);
    add_emission(table);
    add_weights(table);
    add_sets(table);
}

}  // namespace ir::methods::photon_mapping
