#pragma once

#include <string>

#include "projects/object_reader.h"
#include "renderers/core/words.h"

namespace ir::engine {

/// Null for what is not finite, which JSON cannot say; why_not_finite() goes beside it.
projects::Json number_json(double value);
/// Back, given the text beside it; the first builds wrote "inf", "-inf" and "nan" instead. `key`: of the
/// reader's member, for the InputError.
double number_from(const projects::Json& json, const std::string& reason,
                   const projects::ObjectReader& reader, const std::string& key);

/// The member is an array of texts; absent: none. Throws InputError.
std::vector<std::string> read_texts(projects::ObjectReader& reader, const std::string& key);

std::string csv_number(double value);
std::string csv_value(const projects::Json& value);

}  // namespace ir::engine
