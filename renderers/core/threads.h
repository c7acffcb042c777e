#pragma once

namespace ir {

/// For a tbb::task_arena: as many threads as are asked for; 0: as many as there are.
inline int arena_size(int threads) {
    constexpr int automatic = -1;  // tbb::task_arena::automatic
    return threads > 0 ? threads : automatic;
}

}  // namespace ir
