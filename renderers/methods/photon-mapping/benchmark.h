#pragma once

#include <vector>

#include "renderers/graph/benchmark.h"

namespace ir::methods::photon_mapping {

/// The pipeline at a size for software rendering, grown in one parameter after the other; and the published
/// settings. Time to an error that a path tracer has, too, is no benchmark of a method alone: plots of a
/// project measure it (`bench error --project`).
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::photon_mapping
