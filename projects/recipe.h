#pragma once

#include <filesystem>

#include "projects/document.h"

namespace ir::projects {

/// A project of one experiment, as it runs, and of what it uses: all that is needed to render its picture
/// again. Files have absolute paths. What the project does not have is not there either.
Project recipe_of(const Project& project, const Experiment& experiment, const std::filesystem::path& folder);

}  // namespace ir::projects
