#pragma once

#include "renderers/graph/resource.h"
#include "renderers/methods/ldm-indirect/splatting.h"

namespace ir::methods::ldm_indirect {

/// What the output of this key says of itself, for the resource that holds it.
graph::ResourceText text_of_output(const std::string& key);

/// Declares the output of this key, of the view's size.
graph::ImageRef output_image(graph::GraphBuilder& builder, const std::string& key);

}  // namespace ir::methods::ldm_indirect
