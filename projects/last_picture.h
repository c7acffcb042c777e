#pragma once

#include <filesystem>

namespace ir::projects {

/// Copies the picture that a project kept last, an EXR file, to `file`; the project may be packed. False
/// where it keeps none. Throws InputError.
bool copy_last_picture(const std::filesystem::path& project, const std::filesystem::path& file);

}  // namespace ir::projects
