#pragma once

#include "renderers/graph/builder.h"

namespace ir::methods::ssdo {

/// Extent of the map that directions look up, texels.
constexpr int environment_width = 64, environment_height = 32;

/// Declares the pass "environment" and "ssdo.environment", rgba32f: radiance of the scene's environment,
/// equirectangular, each texel the mean over its solid angle, so that few directions miss little of a small
/// sun. 0 where `lit` is false.
graph::ImageRef environment(graph::GraphBuilder& builder, bool lit);

}  // namespace ir::methods::ssdo
