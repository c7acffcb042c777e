#pragma once

#include <string>
#include <vector>

#include "renderers/scene/scene.h"

namespace ir::engine {

/// Hexadecimal digits that are equal exactly where lights and environment are: for the attributes of
/// pictures, so that those of different lighting are not compared unawares.
std::string lighting_digest(const std::vector<scene::Light>& lights, const scene::Environment& environment);

}  // namespace ir::engine
