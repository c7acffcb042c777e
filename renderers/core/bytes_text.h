#pragma once

#include <cstdint>
#include <string>

namespace ir {

/// "812 B", "1.50 MiB": three digits.
std::string bytes_text(std::uint64_t bytes);

}  // namespace ir
