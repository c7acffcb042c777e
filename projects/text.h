#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderers/core/words.h"

namespace ir::projects {

/// Text from a file or user, fit for one line of a message: control characters become '?', and what is longer
/// than `longest` bytes is cut.
std::string printable(std::string_view text, std::size_t longest = 160);

using ir::listed;

/// One more step of a JSON pointer, escaped as RFC 6901 wants it.
std::string pointer_to(const std::string& parent, std::string_view key);
std::string pointer_to(const std::string& parent, std::size_t index);

/// Date and time now: "2024-05-01T12:00:00Z".
std::string utc_now();

}  // namespace ir::projects
