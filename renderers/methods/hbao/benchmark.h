#pragma once

#include <vector>

#include "renderers/graph/benchmark.h"

namespace ir::methods::hbao {

/// "hbao": the sensible setting and that of Aalund 2015's baseline; "hbao-radius": radii from 0.25 to 12.8 m.
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::hbao
