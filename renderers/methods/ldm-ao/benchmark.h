#pragma once

#include <vector>

#include "renderers/graph/benchmark.h"

namespace ir::methods::ldm_ao {

/// Build and trace by each builder and storage against ray tracing of the same directions, and the memory of
/// the published settings.
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::ldm_ao
