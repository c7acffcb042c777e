#pragma once

#include <functional>
#include <string>
#include <vector>

namespace ir::gl {

/// The errors of a compiler's or linker's log, each in one line. Where the log names a line of the source,
/// `place_of` turns it into "file:line"; the result reads "file:line: message". Errors without a place
/// follow; warnings are left out, unless there is nothing else. Understands Mesa ("0:12(3): error: …"),
/// NVIDIA
/// ("0(12) : error C1008: …") and the reference compiler ("ERROR: 0:12: …").
std::vector<std::string> shader_errors(const std::string& log,
                                       const std::function<std::string(std::size_t line)>& place_of);

}  // namespace ir::gl
