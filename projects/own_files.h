#pragma once

#include <filesystem>

#include "projects/store.h"

namespace ir::projects {

/// Whether the file is the project's: its document, what is written beside it, a kept result, or a file of a
/// scene, an environment or an image. Links are followed; the file need not exist.
bool is_own_file(const LoadedProject& project, const std::filesystem::path& file);

}  // namespace ir::projects
