#pragma once

#include <optional>

#include "renderers/core/parameter.h"

namespace ir::engine {

/// The value of a number a step down (-1) or up (1): an eighth of what its slider spans, or, where that spans
/// a factor of 20 or more, the eighth root of the factor. Whole numbers move by 1 at least. Nothing where it
/// is at its end, or no range says how long a step is.
std::optional<Value> stepped(const ParameterDescription& parameter, const Value& value, int direction);

}  // namespace ir::engine
