#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "renderers/core/method.h"
#include "renderers/core/record.h"
#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "shaders/methods/deep-screen-space/splatting/explain_pixel.comp.h"
#include "shaders/methods/deep-screen-space/splatting/explain_surfel.comp.h"

namespace ir::methods::deep_screen_space {
/// What became of a splat on a pixel: as the constants SPLAT_… of
/// shaders/methods/deep-screen-space/splatting/visible_hit.glsl.
struct SplatOutcome {
    enum : std::uint32_t { none, outside, missed, too_far, refused, hit, level, wins };
};

/// Repeats depth test and combination over what was found: outcomes of candidates that were hit, and of
/// `sums` (a row per sample and level, sample-major) the winners. Then sorts candidates by sample, outcome
/// (winners first), level, z and surfel. [Nalbach15 §4.2]
void judge(std::span<SplatCandidate> candidates, std::span<LevelSum> sums, int levels, bool nearest_decides);

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

}  // namespace ir::methods::deep_screen_space
