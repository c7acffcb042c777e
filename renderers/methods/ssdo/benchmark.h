#pragma once

#include <vector>

#include "renderers/graph/benchmark.h"

namespace ir::methods::ssdo {

/// "ssdo": numbers of samples, with and without the blur, and the published estimator.
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::ssdo
