#pragma once

#include "renderers/graph/resource.h"
#include "renderers/methods/ldm-indirect/splatting.h"

namespace ir::methods::ldm_indirect {

/// Declares the output of this key, of the view's size.
graph::ImageRef output_image(graph::GraphBuilder& builder, const std::string& key);

}  // namespace ir::methods::ldm_indirect
