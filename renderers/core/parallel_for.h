#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstdint>

#include "renderers/core/threads.h"

namespace ir {

/// Calls run(i) for begin ≤ i < end, in any order and in as many threads as are asked for; 0: all there are.
template <class Run>
void parallel_for(int threads, std::int64_t begin, std::int64_t end, const Run& run) {
    tbb::task_arena arena(arena_size(threads));
    arena.execute([&] { tbb::parallel_for(begin, end, run); });
}

}  // namespace ir
