#pragma once

#include <string>

namespace ir::projects {

/// What parse_light() takes: for each type the shortest example, and a line for each field. Without the last
/// line's end.
std::string light_help();

}  // namespace ir::projects
