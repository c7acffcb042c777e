#pragma once

#include <string>

#include "projects/json.h"

namespace ir::engine {

/// JSON has no infinities, but equal pictures have an infinite PSNR: "inf", "-inf", "nan".
projects::Json number_json(double value);

/// A field of a table [RFC 4180 §2].
std::string csv_field(const std::string& text);
std::string csv_number(double value);

}  // namespace ir::engine
