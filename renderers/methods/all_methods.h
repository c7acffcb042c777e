#pragma once

#include <vector>

#include "renderers/graph/method.h"

namespace ir::methods {

/// Every method of this build, in order of id.
const std::vector<const graph::Method*>& all_methods();

}  // namespace ir::methods
