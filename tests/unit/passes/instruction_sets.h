#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderers/passes/vectors/targets.h"

#include <hwy/targets.h>

namespace ir::passes {

/// The instruction sets that this machine has of those that sources with vectors are compiled for, as bits,
/// the best one first.
inline std::vector<std::int64_t> instruction_sets() {
    std::vector<std::int64_t> sets;  // better ones have lower bits
    for (auto left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1)
        sets.push_back(left & -left);
    return sets;
}

/// The one that runs: "AVX3", "AVX2", "SSE4" or "SCALAR".
inline std::string instruction_set() {
    const auto sets = instruction_sets();
    return sets.empty() ? "" : hwy::TargetName(sets.front());
}

/// From now on this one alone runs; 0: the best again.
inline void force_instruction_set(std::int64_t set) {
    hwy::SetSupportedTargetsForTest(set);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace ir::passes
