#pragma once

#include <map>

#include "renderers/core/method.h"
#include "renderers/methods/deep-screen-space/splatting.h"
#include "renderers/methods/deep-screen-space/splatting/splats.h"
#include "renderers/methods/deep-screen-space/splatting/visible.h"

namespace ir::methods::deep_screen_space {
/// Declares the pass "bounds of positions" and `hierarchy.min` and `max`, down to one texel. A pixel
/// (x, y) lies on mip level m below the texel (min(x >> m, width_m - 1), …). [Nalbach15 §4.3]
void bound_positions(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, Hierarchy& hierarchy);

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

/// What explains splats with visibility: all that were splatted onto the picked pixel, found by a search over
/// all surfels, and what became of one surfel's splats on each level.
struct SplatExplanation {
    graph::CountedBuffer candidates, levels, surfel;
    graph::BufferRef choice;
    graph::ImageRef cover;
};
SplatExplanation declare_explanation(graph::GraphBuilder& builder, const VisibleSplats& visible,
                                     int all_samples);
/// Declares the passes that explain a batch, which was splatted.
void explain_splats(graph::GraphBuilder& builder, const SplatExplanation& explanation,
                    const VisibleSplats& visible, const passes::bounce::Batch& batch);
/// Declares the pass that judges all batches.
void judge_splats(graph::GraphBuilder& builder, const SplatExplanation& explanation,
                  const VisibleSplats& visible, int all_samples);

std::vector<OutputDescription> explanation_outputs();  ///< only with visibility

/// "surfel": 0 is the one under the cursor, others are 1 + index, as winners are numbered.
SelectorDescription surfel_selector();

/// Declares the pass "framebuffer layout" on the host's threads: what layout.comp writes, bit by bit.
void lay_out_on_host(graph::GraphBuilder& builder, const Hierarchy& hierarchy, unsigned seed);

}  // namespace ir::methods::deep_screen_space
