#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderers/graph/resource.h"

namespace ir::methods::deep_screen_space {

/// What became of a splat on a pixel: as the constants SPLAT_… of
/// shaders/methods/deep-screen-space/splatting/visible_hit.glsl.
enum class SplatOutcome : std::uint32_t { none, outside, missed, too_far, own, hit, level, wins };

/// As in explain_pixel.comp.
struct SplatCandidate {
    std::array<float, 3> centre, normal;
    float radius;
    std::uint32_t surfel, sample, level, shell;
    SplatOutcome outcome;
    float distance, z;
};
static_assert(sizeof(SplatCandidate) == 14 * 4);

struct LevelSum {
    std::uint32_t sample, level, splats;
    std::array<std::uint32_t, 5> outcomes;  ///< from `outside` to `hit`
    std::uint32_t found, kept, is_nearest;
    float found_z, kept_z;
};
static_assert(sizeof(LevelSum) == 13 * 4);

/// As in explain_surfel.comp.
struct SurfelSum {
    std::array<float, 3> centre, normal;
    float radius;
    std::uint32_t surfel, level, splats, hits, level_wins, wins;
};
static_assert(sizeof(SurfelSum) == 13 * 4);

std::vector<graph::Field> candidate_fields();
std::vector<graph::Field> level_sum_fields();
std::vector<graph::Field> surfel_sum_fields();

/// Repeats depth test and combination over what was found: outcomes of candidates that were hit, and of
/// `sums` (a row per sample and level, sample-major) the winners. Then sorts candidates by sample, outcome
/// (winners first), level, z and surfel. [Nalbach15 §4.2]
void judge(std::span<SplatCandidate> candidates, std::span<LevelSum> sums, int levels, bool nearest_decides);

}  // namespace ir::methods::deep_screen_space
