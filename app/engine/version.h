#pragma once

#include <string>

namespace ir::engine {

/// "0.1.0"
std::string version();

}  // namespace ir::engine
