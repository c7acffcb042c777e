#pragma once

#include "renderers/core/transport.h"

namespace ir {

/// What methods compute at their defaults, so that one can be put beside another as they are: those of
/// ambient occlusion what is near, as nothing is open in a closed room; those of light the whole picture. A
/// method's own struct begins with one of them.
inline constexpr Transport default_occlusion{.paths = Transport::Paths::ao, .max_distance = 1};
inline constexpr Transport default_light{.paths = Transport::Paths::full, .max_distance = 0};

}  // namespace ir
