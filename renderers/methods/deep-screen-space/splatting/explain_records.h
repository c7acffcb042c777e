#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "renderers/core/record.h"
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

}  // namespace ir::methods::deep_screen_space
