#pragma once

#include <vector>

#include "renderers/graph/benchmark.h"

namespace ir::methods::ldm_indirect {

/// What grows with directions, photons and texels, and the published setting.
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::ldm_indirect
