#include "renderers/methods/deep-screen-space/parameters.h"

namespace ir::methods::deep_screen_space {
namespace {

const Condition only_with_visibility{"visibility", {true}};
const Condition additive{"visibility", {false}};

void add_reach(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::levels,
             {.key = "levels",
              .label = "Levels",
              .doc = "Of the hierarchical framebuffer. Level l sees each surfel at one of 4^l pixels and "
                     "reaches 2^l times as far as the first. More levels do less work per distance and are "
                     "coarser: with a maximum distance the first shell is 1/2^(levels − 1) of it.",
              .citation = "Nalbach15 §4.1",
              .hard = {1, max_levels},
              .soft = {1, max_levels},
              .on_change = OnChange::reallocate})
        .add(
            &Parameters::shell_radius,
            {.key = "shell_radius",
             .label = "Shell radius",
             .doc = "d: how far surfels reach on level 0, and on level l 2^l times as far, where there is no "
                    "maximum distance; where there is one the last level reaches it, and this does not "
                    "count. Nothing farther away than d · 2^(levels − 1) has an effect. 0: 1/64 of the "
                    "diagonal of the scene's bounds.",
             .unit = "m",
             .citation = "Nalbach15 §4.1",
             .hard = {0, 1e9},
             .soft = {0, 2},
             .active_when = {"max_distance", {0.0}}})
        .add(&Parameters::last_shell,
             {.key = "last_shell",
              .label = "Last shell",
              .doc = "Where the shell of the coarsest level ends.",
              .citation = "Nalbach15 §4.1",
              .choices = {{"ends", "Ends", "At twice the radius of the one before, as published."},
                          {"open", "Open",
                           "At the maximum distance, or at the end of the scene: far surfaces count, each "
                           "seen by as few pixels as the last level has it. With estimated influence no "
                           "first shell is widened to make the levels suffice."}},
              .since_version = 2,
              .value_in_older_projects = std::string("ends")});
}

void add_visible(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::sub_images,
             {.key = "sub_images",
              .label = "Choice of sub-images",
              .doc = "Which of the 4^l sub-images of level l a surfel is splatted into.",
              .citation = "Nalbach15 §4.1",
              .choices = {{"independent", "Independent", "Drawn for each surfel by itself, as published."},
                          {"stratified", "Stratified",
                           "In turn, in the order of the surfels, from a random one on. With systematic "
                           "placement neighbours take different ones, so that sub-images leak less."}},
              .since_version = 2,
              .value_in_older_projects = std::string("independent")})
        .add(&Parameters::shells,
             {.key = "shells",
              .label = "Shells",
              .doc = "Which of the surfaces that a splat covers it affects.",
              .citation = "Nalbach15 §4.3",
              .choices = {{"full-discs", "Full discs",
                           "All within its reach: those of inner shells as if they had been splatted on the "
                           "finer level. Hits of finer levels stay, and what they missed is filled in."},
                          {"shells", "Shells",
                           "Those between half its reach and its reach, as on all levels but the first in "
                           "2014."}},
              .active_when = only_with_visibility})
        .add(&Parameters::coverage,
             {.key = "coverage",
              .label = "Coverage",
              .doc =
                  "Area of a disc that rays are tested against, in areas of the surface that it stands for. "
                  "Discs at random leave e^(−coverage) of all rays through a closed surface (with full discs "
                  "beyond the first shell a little less); large discs reach around edges.",
              .hard = {0.01, 100},
              .soft = {0.5, 8},
              .active_when = only_with_visibility})
        .add(&Parameters::discs,
             {.key = "discs",
              .label = "Discs that count",
              .doc = "Which of the discs that a ray meets count for the pixel that it starts from.",
              .citation = "Nalbach15 §3.2",
              .choices =
                  {{"all", "All", "As published: surfaces shade themselves."},
                   {"above", "Above", "Those with their centre above the plane of the pixel's triangle."},
                   {"seen", "Seen",
                    "Of those the ones whose centre the pixel sees, by a ray through the scene's triangles. "
                    "Discs that hang over edges, or belong to what is hidden, block nothing and send "
                    "nothing, so that a larger coverage closes leaks and no gaps."}},
              .active_when = only_with_visibility,
              .since_version = 2,
              .value_in_older_projects = std::string("above")})
        .add(&Parameters::borders,
             {.key = "borders",
              .label = "Borders of surfaces",
              .doc = "What discs do beyond the border of the surface that they stand for.",
              .citation = "Nalbach15 §4.1",
              .choices = {{"overhang", "Overhang", "They count there, too, as published."},
                          {"clipped", "Clipped",
                           "They count only where a triangle lies close to the place that is met, by a short "
                           "ray. Hits are right, and what is smaller than its discs is met too seldom."}},
              .active_when = only_with_visibility,
              .since_version = 8,
              .value_in_older_projects = std::string("overhang")})
        .add(&Parameters::disc_light,
             {.key = "disc_light",
              .label = "Light of discs",
              .doc = "What a disc sends that stands for 4^l surfels.",
              .citation = "Nalbach15 §4.1",
              .choices =
                  {{"centre", "Of its centre",
                    "As published: the light of one surfel, in place of that of 4^l. Where few surfels are "
                    "bright, as beside a lamp, few rays meet them: the picture has blotches."},
                   {"averaged", "Averaged",
                    "The mean of up to 16 of the surfels in the disc, others for each ray. Highlights are as "
                    "much wider as the disc is wide. With visibility."}},
              .active_when = only_indirect,
              .since_version = 5,
              .value_in_older_projects = std::string("centre")})
        .add(&Parameters::level0,
             {.key = "level0",
              .label = "Level 0",
              .doc = "What rays meet as far as the first shell of a surfel at the pixel reaches.",
              .citation = "Nalbach15 §4.1",
              .choices = {{"discs", "Discs", "Surfels, as published."},
                          {"triangles", "Triangles",
                           "The scene's triangles, by an exact ray; discs count beyond. Nothing leaks or "
                           "hangs over edges where it is seen best."}},
              .exact = {"triangles"},
              .active_when = only_with_visibility,
              .since_version = 3,
              .value_in_older_projects = std::string("discs")})
        .add(
            &Parameters::glass,
            {.key = "glass",
             .label = "Glass",
             .doc =
                 "What rays of light do at glass, with visibility. Ambient occlusion takes it for opaque, as "
                 "the reference does.",
             .citation = "Nalbach15 §6",
             .choices =
                 {{"opaque", "Opaque", "It stops them, and sends only what its opaque part reflects."},
                  {"hashed", "Hashed acceptance",
                   "They go straight on behind it as often as the glass lets light through, by a hash of "
                   "the ray and of the material's side. Light that glass reflects or bends, its colour, and "
                   "what a volume absorbs are left out. Materials whose transmission has a texture stay "
                   "opaque."}},
             .active_when = only_indirect,
             .since_version = 7,
             .value_in_older_projects = std::string("opaque")});
}

void add_additive(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::influence,
             {.key = "influence",
              .label = "Influence",
              .doc = "How far a surfel reaches on level 0.",
              .citation = "Nalbach14",
              .choices =
                  {{"constant", "Constant",
                    "All as far: 1/2^(levels − 1) of the whole reach, which is the maximum distance. Where "
                    "that is few of a surfel's radii, what is near is as coarse as what is far, and as "
                    "blurred."},
                   {"estimated", "Estimated",
                    "To where a surfel's form factor has fallen to the trade-off: radius / √ε, which is as "
                    "many pixels near and far; farther where levels would not suffice for the whole reach. "
                    "With visibility the nearest hit of all levels decides, as levels are no ranges of "
                    "distance."}}})
        .add(
            &Parameters::trade_off,
            {.key = "trade_off",
             .label = "Trade-off ε",
             .doc = "Form factor at which a surfel's first shell ends. Larger is faster and coarser: surfels "
                    "stand for their surroundings from closer by.",
             .citation = "Nalbach15 §5",
             .hard = {1e-6, 1},
             .soft = {0.001, 0.1},
             .active_when = {"influence", {std::string("estimated")}}});
}

}  // namespace

void add_splatting_parameters(ParameterTable<Parameters>& table) {
    add_reach(table);
    add_visible(table);
    add_additive(table);
    table.add(&Parameters::splat_culling,
              {.key = "splat_culling",
               .label = "Splat culling",
               .doc = "Splats are left out that reach none of the surfaces seen in the part of the picture "
                      "that they cover, and others are cut to where they reach some, by the bounds of "
                      "positions. Changes no pixel.",
               .citation = "Nalbach15 §4.3",
               .effect = Effect::cost,
               .on_change = OnChange::nothing});
}

}  // namespace ir::methods::deep_screen_space
