#pragma once

#include <string>

namespace ir::projects {

/// Where the numbers of a plot are kept, relative to results/, '/' as separator.
std::string study_path(const std::string& plot);

}  // namespace ir::projects
