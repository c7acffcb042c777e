#pragma once

#include <vector>

#include "renderers/graph/benchmark.h"

namespace ir::methods::ambient_occlusion_volumes {

/// "ambient-occlusion-volumes": the additive and the bounced form on one scene, over samples and distances.
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::ambient_occlusion_volumes
