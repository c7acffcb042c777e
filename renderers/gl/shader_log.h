#pragma once

#include <string>
#include <vector>

namespace ir::gl {

/// The errors of a compiler's or linker's log, each in one line; where the log gives a place it is translated
/// with `files` (by string number) to "file:line: message". Warnings are left out. Understands Mesa
/// ("0:12(3): error: …"), NVIDIA ("0(12) : error C1008: …") and the reference compiler ("ERROR: 0:12: …");
/// lines of other forms are kept as they are. Never empty for a log that is not.
std::vector<std::string> shader_errors(const std::string& log, const std::vector<std::string>& files);

}  // namespace ir::gl
