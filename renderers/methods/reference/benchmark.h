#pragma once

#include <vector>

#include "renderers/graph/benchmark.h"

namespace ir::methods::reference {

std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::reference
