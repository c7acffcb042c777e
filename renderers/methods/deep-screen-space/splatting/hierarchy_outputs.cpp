
#include "renderers/methods/deep-screen-space/splatting.h"

namespace ir::methods::deep_screen_space {

std::vector<OutputDescription> hierarchy_outputs() {
    return {
        {.key = "hierarchy.colours",
         .label = "Sub-images",
         .kind = OutputKind::stack,
         .semantic = Semantic::albedo,
         .doc = "The picture's base colours on each level of the hierarchical framebuffer: level l (a layer) "
                "is 2^l × 2^l small pictures side by side, each with one pixel, at random, of every "
                "neighbourhood of 2^l × 2^l. Black: padding and background."},
        {.key = "hierarchy.layout",
         .label = "Layout of the levels",
         .kind = OutputKind::stack,
         .semantic = Semantic::id,
         .doc = "Which pixel of the view stands at a place of a level: x + 65536 y; 4294967295 is padding. "
                "A layer per level."},
        {.key = "hierarchy.places",
         .label = "Places on the levels",
         .kind = OutputKind::stack,
         .semantic = Semantic::id,
         .doc = "Where a pixel of the (padded) view stands on a level: x + 65536 y. A layer per level."},
        {.key = "hierarchy.positions",
         .label = "Shuffled positions",
         .kind = OutputKind::stack,
         .semantic = Semantic::position,
         .unit = "m",
         .doc = "Positions of the view's surfaces at their places on each level; alpha 0: no surface."},
        {.key = "hierarchy.normals",
         .label = "Shuffled normals",
         .kind = OutputKind::stack,
         .semantic = Semantic::normal,
         .doc = "Shading normals of the view's surfaces at their places on each level."},
        {.key = "hierarchy.min",
         .label = "Minimum positions",
         .kind = OutputKind::pyramid,
         .semantic = Semantic::position,
         .unit = "m",
         .doc =
             "Minimum x, y and z of all surfaces seen below a texel, on each mip level: with the maximum ones "
             "the box that splats are culled against. 3e38: no surface."},
        {.key = "hierarchy.max",
         .label = "Maximum positions",
         .kind = OutputKind::pyramid,
         .semantic = Semantic::position,
         .unit = "m",
         .doc =
             "Maximum x, y and z of all surfaces seen below a texel, on each mip level; -3e38: no surface."},
    };
}

}  // namespace ir::methods::deep_screen_space
