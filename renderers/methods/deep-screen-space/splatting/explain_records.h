#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "renderers/core/record.h"

namespace ir::methods::deep_screen_space {

/// What became of a splat on a pixel: as the constants SPLAT_… of
/// shaders/methods/deep-screen-space/splatting/visible_hit.glsl.
struct SplatOutcome {
    enum : std::uint32_t { none, outside, missed, too_far, own, hit, level, wins };
};

/// As in explain_pixel.comp.
struct SplatCandidate {
    std::array<float, 3> centre, normal;
    float radius;
    std::uint32_t surfel, sample, level, shell, outcome;
    float distance, z;
    IR_FIELDS(centre, normal, radius, surfel, sample, level, shell, outcome, distance, z)
};

struct LevelSum {
    std::uint32_t sample, level, splats;
    std::uint32_t outside, missed, too_far, own, hits;  ///< as in SplatOutcome
    std::uint32_t found, kept, nearest;
    float found_z, kept_z;
    IR_FIELDS(sample, level, splats, outside, missed, too_far, own, hits, found, kept, nearest, found_z,
              kept_z)
};

/// As in explain_surfel.comp.
struct SurfelSum {
    std::array<float, 3> centre, normal;
    float radius;
    std::uint32_t surfel, level, splats, hits, level_wins, wins;
    IR_FIELDS(centre, normal, radius, surfel, level, splats, hits, level_wins, wins)
};

/// Repeats depth test and combination over what was found: outcomes of candidates that were hit, and of
/// `sums` (a row per sample and level, sample-major) the winners. Then sorts candidates by sample, outcome
/// (winners first), level, z and surfel. [Nalbach15 §4.2]
void judge(std::span<SplatCandidate> candidates, std::span<LevelSum> sums, int levels, bool nearest_decides);

}  // namespace ir::methods::deep_screen_space
