#include "renderers/methods/deep-screen-space/splatting/explain_records.h"

#include <algorithm>
#include <tuple>

namespace ir::methods::deep_screen_space {
namespace {

/// LESS in the order of the surfels.
void keep_nearest(const SplatCandidate& candidate, LevelSum& sum) {
    const bool nearer =
        sum.found == 0 || std::tuple(candidate.z, candidate.surfel) < std::tuple(sum.found_z, sum.found);
    if (!nearer) return;
    sum.found = candidate.surfel;
    sum.found_z = candidate.z;
}

void mark_deciding(std::span<LevelSum> sums, int levels, bool nearest_decides) {
    for (std::size_t first = 0; first < sums.size(); first += static_cast<std::size_t>(levels)) {
        LevelSum* deciding = nullptr;
        for (auto& sum : sums.subspan(first, static_cast<std::size_t>(levels)))
            if (sum.found != 0 && (!deciding || (nearest_decides && sum.found_z < deciding->found_z)))
                deciding = &sum;
        if (deciding) deciding->nearest = 1;
    }
}

}  // namespace

void judge(std::span<SplatCandidate> candidates, std::span<LevelSum> sums, int levels, bool nearest_decides) {
    const auto sum_of = [&](const SplatCandidate& c) -> LevelSum& {
        return sums[c.sample * static_cast<std::size_t>(levels) + c.level];
    };
    for (auto& sum : sums) sum.found_z = 1;
    for (const auto& c : candidates)
        if (c.outcome == SplatOutcome::hit) keep_nearest(c, sum_of(c));
    mark_deciding(sums, levels, nearest_decides);
    for (auto& c : candidates)
        if (c.outcome == SplatOutcome::hit && sum_of(c).found == c.surfel)
            c.outcome = sum_of(c).nearest ? SplatOutcome::wins : SplatOutcome::level;
    std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
        return std::tuple(a.sample, b.outcome, a.level, a.z, a.surfel) <
               std::tuple(b.sample, a.outcome, b.level, b.z, b.surfel);
    });
}

}  // namespace ir::methods::deep_screen_space
