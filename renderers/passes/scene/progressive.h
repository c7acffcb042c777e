#pragma once

#include <cstdint>

#include "renderers/graph/frame_inputs.h"

/// Pictures that are the mean of all frames in which nothing moves, each with random numbers of its own.
namespace ir::passes {

/// Frames before this one that saw the same surfaces and lights. A motion of the document that has ended
/// counts as standing, so that radii go on from there while the history begins anew.
int frames_standing(const graph::FrameInputs& inputs);

/// Radii of a frame over those of the first, frames counting from 0 and a decay of α: r² shrinks by
/// (k + α)/(k + 1) from the k-th frame to the next, k from 1.  [Knaus11 eq. 18]
float progressive_shrinking(int frame, float decay);

/// Seed of what is random in this frame alone.
std::uint64_t frame_seed(const graph::FrameInputs& inputs);

}  // namespace ir::passes
