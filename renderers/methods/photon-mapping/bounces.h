#pragma once

#include <string>

#include "renderers/core/category.h"

namespace ir::methods::photon_mapping {

/// Bounces with names and colours: red, green and blue for the first three, as published [Smal19 fig. 8.1a].
Categories bounce_categories(const std::string& field);

}  // namespace ir::methods::photon_mapping
