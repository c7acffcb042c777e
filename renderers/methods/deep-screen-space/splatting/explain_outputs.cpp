#include "renderers/methods/deep-screen-space/splatting/steps.h"

namespace ir::methods::deep_screen_space {
namespace {

/// By SplatOutcome.
const std::vector<Category> outcomes{
    {0, "does not cover the pixel", tints::dark},
    {1, "the pixel's point lies in no shell of the level", tints::grey},
    {2, "the ray misses the disc", tints::sky},
    {3, "met beyond the maximum distance", tints::blue},
    {4, "does not count for the pixel, by discs, backs or level 0", tints::purple},
    {5, "met, something is nearer on this level", tints::yellow},
    {6, "nearest on its level, another level decides", tints::vermilion},
    {7, "what the ray met", tints::green}};

}  // namespace

std::vector<OutputDescription> explanation_outputs() {
    std::vector<OutputDescription> outputs = {
        {.key = "splats.explain.candidates",
         .label = "Splats onto the pixel",
         .kind = OutputKind::glyphs,
         .doc = "Discs, as large as they were tested, of surfels that were splatted onto the pixel; found by "
                "a search over all surfels, and those of outcome 1 left out. surfel: 1 + index; sample, "
                "level: where it was splatted; shell: which its disc was enlarged for. distance: m along the "
                "ray to the disc's plane; z: what the depth test compares.",
         .categories = {{"outcome", outcomes}},
         .when_empty = no_surface,
         .explains = true},
        {.key = "splats.explain.levels",
         .label = "Levels of the pixel",
         .kind = OutputKind::table,
         .doc = "For each sample and level how many splats covered the pixel, and how many of them had which "
                "outcome (hits: 5 to 7). found: 1 + index of the nearest by the search, with its z; kept: "
                "what the framebuffer holds, which has to be the same. nearest: 1 on the level whose hit "
                "counts.",
         .when_empty = no_surface,
         .explains = true},
        {.key = "splats.explain.choice",
         .label = "Surfel explained",
         .kind = OutputKind::table,
         .doc = "surfel: 1 + index of the surfel that was chosen, or else of the one nearest to the picked "
                "pixel's point, with 1 / distance² in 1/m²; 0: none.",
         .explains = true},
        {.key = "splats.explain.surfel",
         .label = "Splats of the surfel",
         .kind = OutputKind::glyphs,
         .doc = "The chosen surfel's disc, as large as each level tests it in its own shell, and how many "
                "rays of the picture, of all samples, its splat on that level covered, met, and won on the "
                "level and in the end.",
         .explains = true},
        {.key = "splats.explain.cover",
         .label = "Where the surfel was splatted",
         .kind = OutputKind::stack,
         .doc =
             "What became of the chosen surfel's splat on each pixel, a layer per level; of all samples the "
             "outcome that went farthest.",
         .categories = {{"", outcomes}},
         .explains = true},
    };
    for (auto& output : outputs) output.active_when = {"visibility", {true}};
    return outputs;
}

SelectorDescription surfel_selector() {
    return {.key = "surfel",
            .label = "Surfel",
            .doc =
                "1 + index of a surfel, as winners are numbered. 0, or all: the one nearest to the picked "
                "pixel's point.",
            .count = 1 << 24};
}

}  // namespace ir::methods::deep_screen_space
