#include "renderers/methods/deep-screen-space/parameters.h"

namespace ir::methods::deep_screen_space {
namespace {

void add_sizes(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::surfel_radius, {.key = "surfel_radius",
                                          .label = "Surfel radius",
                                          .doc = "Of the ideal surfel, seen face on: surfels cover as many "
                                                 "pixels at every distance. Twice the radius needs a quarter "
                                                 "of the surfels.",
                                          .unit = "pixels",
                                          .citation = "Nalbach15 §4.1",
                                          .hard = {0.1, 100},
                                          .soft = {0.5, 8}})
        .add(&Parameters::placement,
             {.key = "placement",
              .label = "Placement",
              .doc = "Where surfels lie on their triangle.",
              .citation = "Nalbach15 §4.3",
              .choices =
                  {{"random", "Random",
                    "Uniformly at random: thin triangles are covered evenly. Small triangles share surfels "
                    "by thinning."},
                   {"barycentric", "Tessellator's pattern",
                    "As published in 2014: at the points of the tessellation, without thinning. Each "
                    "triangle has three surfels at least, however small it is."},
                   {"systematic", "Systematic",
                    "One at random in each piece of a curve through all triangles that is worth a surfel. "
                    "The curve follows space, so that surfels are spread evenly also over many small "
                    "triangles. No tessellation and no thinning."}}})
        .add(
            &Parameters::fine_area,
            {.key = "fine_area",
             .label = "Fine area",
             .doc =
                 "Area that tessellation aims at before thinning, as a multiple of the ideal one. Smaller: less "
                 "regular surfels of more equal area; more work.",
             .citation = "Nalbach15 §4.3",
             .hard = {0.02, 1},
             .soft = {0.1, 1},
             .active_when = {"placement", {std::string("random")}}});
}

void add_thinning(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::thinning, {.key = "thinning",
                                     .label = "Thinning",
                                     .doc = "Fine surfels are discarded at random until those left have the "
                                            "ideal area; together they keep the surface's area, on average.",
                                     .citation = "Nalbach15 §4.3",
                                     .active_when = {"placement", {std::string("random")}}})
        .add(&Parameters::discard,
             {.key = "discarding",
              .label = "Discarding",
              .doc = "Probability with which a fine surfel of area A is discarded, A* being the ideal area.",
              .citation = "Nalbach15 §4.3",
              .choices = {{"mended", "1 - A/A*",
                           "What is kept stands for the larger area of the two: areas add up."},
                          {"printed", "1 - A*/A, as printed",
                           "Keeps all fine surfels, each at its ideal area: the surface's area grows to a "
                           "multiple."}},
              .active_when = {"thinning", {true}}});
}

void add_light(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::backs,
             {.key = "backs",
              .label = "Back sides",
              .doc = "What surfels do that are met from behind their triangle's winding.",
              .citation = "Nalbach15 §3.2",
              .choices = {{"lit", "Lit", "As all materials are two-sided."},
                          {"black", "Black", "As published: they block light but send none."},
                          {"open", "Open",
                           "They are not met: rays go on. Of closed objects no ray sees a back but through a "
                           "leak, or where a disc hangs over an edge; walls without thickness become "
                           "one-sided. Without visibility as black."}}})
        .add(&Parameters::light_offset,
             {.key = "light_offset",
              .label = "Offset of shadows",
              .doc = "How far above its centre a surfel asks whether a light sees it. A disc stands for the "
                     "surface around its centre; where that lies in a fold, more of it is lit than the "
                     "centre is.",
              .unit = "radii",
              .hard = {0, 4},
              .soft = {0, 0.5},
              .active_when = only_indirect,
              .since_version = 2,
              .value_in_older_projects = 0.0})
        .add(&Parameters::sender_samples,
             {.key = "sender_samples",
              .label = "Light samples of senders",
              .doc = "Of rectangles, disks, emissive meshes and the environment, for each side of a surfel. "
                     "Pixels see many surfels, so few are enough. Highlights take one more for each ray that "
                     "meets a sender. 0: such sources light no surfel.",
              .hard = {0, 1024},
              .soft = {1, 16},
              .active_when = only_indirect,
              .since_version = 3,
              .value_in_older_projects = std::int64_t{0}})
        .add(&Parameters::glossy_senders, {.key = "glossy_senders",
                                           .label = "Glossy senders",
                                           .doc = "Surfels also send the highlights of their direct light, "
                                                  "each towards the surface that it lights. Off: their "
                                                  "diffuse part alone.",
                                           .citation = "Nalbach15 §3.2",
                                           .active_when = only_indirect})
        .add(
            &Parameters::highlight_rays,
            {.key = "highlight_rays",
             .label = "Rays of a highlight",
             .doc =
                 "With visibility: how many of the rays that a pixel gathers meet a highlight of a sender at "
                 "least. Smaller ones are widened as far as these rays are apart, with the same light. 0: "
                 "highlights stay as they are, as published; of one that few rays meet each makes a "
                 "bright blotch.",
             .citation = "Kaplanyan13",
             .hard = {0, 1000},
             .soft = {0, 16},
             .active_when = {"glossy_senders", {true}},
             .since_version = 6,
             .value_in_older_projects = 0.0});
}

void add_costs(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::frustum_culling, {.key = "frustum_culling",
                                            .label = "Frustum culling",
                                            .doc = "Leaves out triangles from which no shell reaches "
                                                   "what the picture shows. The picture stays the same; "
                                                   "with systematic placement other random numbers are "
                                                   "drawn.",
                                            .citation = "Nalbach15 tab. 2",
                                            .effect = Effect::cost,
                                            .on_change = OnChange::nothing})
        .add(&Parameters::reserve, {.key = "reserve",
                                    .label = "Reserve",
                                    .doc = "Surfels per pixel that memory is reserved for at first, with "
                                           "what comes before thinning in proportion. More are found room "
                                           "for when they come, at the price of a second run.",
                                    .unit = "surfels per pixel",
                                    .hard = {0.001, 100},
                                    .soft = {0.5, 16},
                                    .effect = Effect::cost,
                                    .on_change = OnChange::reallocate});
}

}  // namespace

void add_surfel_parameters(ParameterTable<Parameters>& table) {
    add_sizes(table);
    add_thinning(table);
    add_light(table);
    add_costs(table);
}

}  // namespace ir::methods::deep_screen_space
