#pragma once

#include "renderers/graph/resource.h"
#include "renderers/methods/photon-mapping/splatting.h"

namespace ir::methods::photon_mapping {

/// What the output of this key says of itself, for the resource that holds it.
graph::ResourceText text_of_output(const std::string& key);

}  // namespace ir::methods::photon_mapping
