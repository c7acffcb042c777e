#pragma once

#include <string>

#include "projects/json.h"

namespace ir::engine {

/// Null for what is not finite, which JSON cannot say; why_not_finite() goes beside it.
projects::Json number_json(double value);

/// A field of a table [RFC 4180 §2].
std::string csv_field(const std::string& text);
std::string csv_number(double value);

}  // namespace ir::engine
