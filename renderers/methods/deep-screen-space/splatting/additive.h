#pragma once

#include <map>

#include "renderers/methods/deep-screen-space/splatting/splats.h"

namespace ir::methods::deep_screen_space {

/// A sum over surfels on its way from the sub-images to the picture.
struct LevelSums {
    graph::ImageRef stack;                ///< as splatted: of the hierarchy's size, a layer per level
    std::vector<graph::ImageRef> levels;  ///< unshuffled and blurred, of the view's size
};

/// Declares for each level the passes that unshuffle it and blur it, over 2^l times as many pixels. `stack`
/// is what was splatted.
LevelSums blur_levels(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                      const Hierarchy& hierarchy, graph::ImageRef stack, const Parameters& parameters);

/// Declares "additive.levels", the levels unshuffled, for people to look at.
void show_unshuffled(graph::GraphBuilder& builder, const Hierarchy& hierarchy, graph::ImageRef stack);

}  // namespace ir::methods::deep_screen_space
