#include "renderers/methods/deep-screen-space/splatting/visible.h"

namespace ir::methods::deep_screen_space {
namespace {

const std::string layer_order = " A layer per sample and level: sample × levels + level.";
const std::string sub_images = " Pixels stand in the sub-images of their level.";
const std::string where_seen = " Pixels stand where they are seen.";

std::vector<OutputDescription> of_samples() {
    return {
        {.key = "splats.hit_level",
         .label = "Level of the hit",
         .kind = OutputKind::stack,
         .doc = "The level of the hierarchical framebuffer whose hit decided: the finest that has one, or "
                "with estimated influence that of the nearest hit. It is the one that counts. A layer per "
                "sample.",
         .categories = {{"",
                         {{-1, "no hit", tints::dark},
                          {0, "finest level", tints::yellow},
                          {1, "level 1", tints::orange},
                          {2, "level 2", tints::vermilion},
                          {3, "level 3", tints::purple},
                          {4, "level 4", tints::blue},
                          {5, "level 5", tints::sky},
                          {6, "level 6", tints::green}}}}},
        {.key = "splats.nearest",
         .label = "Surfels that were hit",
         .kind = OutputKind::stack,
         .semantic = Semantic::id,
         .doc =
             "1 + index of the surfel that the sample's ray met, or 2147483648 + that of the triangle, where "
             "level 0 is of triangles; 0: nothing was met. A layer per sample."},
        {.key = "splats.epsilon",
         .label = "Implied ε",
         .kind = OutputKind::stack,
         .colour_map = "viridis",
         .doc = "How coarse what was hit is: (r 2^k / t)², with the surfel's radius r, the shell k that its "
                "disc was enlarged for, and the distance t. Large values tell where enlarged discs do not "
                "follow the surface or reach through others. 0: no hit. A layer per sample."},
    };
}

const std::string nearest_z =
    "t²/r² of the nearest surfel along the pixel's ray, r the reach of all levels; 1: none.";
const std::string winners_radiance =
    "What the winners store for the side that was hit: without their highlights, 0 for ambient occlusion. "
    "Alpha 0: none.";

std::vector<OutputDescription> of_levels() {
    return {
        {.key = "splats.depth",
         .label = "Bounced z in sub-images",
         .kind = OutputKind::stack,
         .semantic = Semantic::depth,
         .doc = nearest_z + sub_images + layer_order},
        {.key = "splats.winner",
         .label = "Winners in sub-images",
         .kind = OutputKind::stack,
         .semantic = Semantic::id,
         .doc = "1 + index of the surfel with the smallest z; 0: none." + sub_images + layer_order},
        {.key = "splats.radiance",
         .label = "Radiance in sub-images",
         .kind = OutputKind::stack,
         .semantic = Semantic::radiance,
         .unit = "W/(m² sr)",
         .doc = winners_radiance + sub_images + layer_order},
        {.key = "splats.level_depth",
         .label = "Bounced z by level",
         .kind = OutputKind::stack,
         .semantic = Semantic::depth,
         .doc = nearest_z + where_seen + layer_order},
        {.key = "splats.level_radiance",
         .label = "Radiance by level",
         .kind = OutputKind::stack,
         .semantic = Semantic::radiance,
         .unit = "W/(m² sr)",
         .doc = winners_radiance + where_seen + layer_order},
    };
}

}  // namespace

std::vector<OutputDescription> visible_outputs() {
    auto outputs = of_samples();
    for (auto& output : of_levels()) outputs.push_back(std::move(output));
    for (auto& output : outputs) output.active_when = {"visibility", {true}};
    return outputs;
}

}  // namespace ir::methods::deep_screen_space
