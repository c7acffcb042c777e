#pragma once

#include <stdexcept>
#include <string>

namespace ir::fuzz {

/// For what must hold for any input.
inline void require(bool holds, const std::string& what) {
    if (!holds) throw std::logic_error(what);
}

/// Of a refusal: one line of some length that begins with `begin`.
inline void require_one_line(const std::string& line, const std::string& begin = {}) {
    require(line.find('\n') == std::string::npos && line.rfind(begin, 0) == 0 && line.size() < 1000, line);
}

}  // namespace ir::fuzz
