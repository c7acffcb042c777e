#pragma once

#include <string>

#include "renderers/core/output.h"

namespace ir {

/// Of numbers that are shown through a colour map.
enum class MappedKind { numbers, depths, probabilities, counts, errors, signed_errors };
MappedKind mapped_kind(Semantic semantic);
/// The colour map that they are shown with when nobody chose another.
std::string default_colour_map(MappedKind kind);

}  // namespace ir
