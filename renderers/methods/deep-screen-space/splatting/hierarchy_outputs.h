#pragma once

#include "renderers/graph/resource.h"

namespace ir::methods::deep_screen_space {

/// What the output of the hierarchy with this key says about itself.
graph::ResourceText hierarchy_text(const std::string& key);

}  // namespace ir::methods::deep_screen_space
