#pragma once

#include <vector>

#include "renderers/graph/builder.h"
#include "renderers/methods/reference/parameters.h"

namespace ir::methods::reference {

/// Notes of what a person should know before trusting a picture of light: that nothing shines, that no path
/// counts, that some light cannot be found.
/// `specular`: specular_materials() of the scene.
void note_limits(graph::GraphBuilder& builder, const Parameters& parameters,
                 const std::vector<bool>& specular);

}  // namespace ir::methods::reference
