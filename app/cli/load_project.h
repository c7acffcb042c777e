#pragma once

#include <string>

#include "projects/store.h"

namespace ir::cli {

/// Loads a project that is about to be rendered. What was filled in, and keys that nobody knows, are notes on
/// standard error. Throws InputError.
projects::LoadedProject load_project(const std::string& project);

/// Before work whose results are kept in the project: throws Error where that cannot be; a note where no
/// other process should keep any there at the same time. `project` is what it was called.
void require_results(const std::string& project, const std::filesystem::path& folder);

/// The document with the contents of its files. They are read only where a kept result is judged by them.
projects::Project as_on_disk(const projects::LoadedProject& loaded);

}  // namespace ir::cli
