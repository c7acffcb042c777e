#pragma once

#include <filesystem>

namespace ir {

/// Before reading: throws InputError where the file is not there, or is a folder, device or pipe, which may
/// never end.
void require_regular_file(const std::filesystem::path& file);

}  // namespace ir
