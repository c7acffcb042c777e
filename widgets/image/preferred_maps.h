#pragma once

#include <map>
#include <string>

#include "renderers/core/mapped_kind.h"

namespace ir::widgets {

/// Colour maps that a person prefers to the program's, by kind; for pictures that are shown from then on.
using PreferredMaps = std::map<MappedKind, std::string>;
void prefer_maps(PreferredMaps maps);
std::string preferred_map(MappedKind kind);
/// `described`: what a method says of the output; one that is not the default stays.
std::string preferred_map(Semantic semantic, const std::string& described);

}  // namespace ir::widgets
