#pragma once

#include <vector>

#include "renderers/graph/benchmark.h"

namespace ir::methods::deep_screen_space {

/// The stages of Table 1, the counts of Table 2 and the memory of Table 3 of Nalbach 2015, and how they grow.
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::deep_screen_space
