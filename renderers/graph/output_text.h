#pragma once

#include <string>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/graph/resource.h"

namespace ir::graph {

/// What the output of this key says about itself, for the resource that holds it.
ResourceText text_of(const std::vector<OutputDescription>& outputs, const std::string& key);

}  // namespace ir::graph
