#pragma once

#include "renderers/core/file_system.h"

/// Many files of a folder that nobody knows yet: the disk is waited for once and not for each.
namespace ir {

/// Writes a file that is not there. It may still be on its way to the disk until sync_disk_of() has returned.
/// Throws Error.
void write_new_file(const std::filesystem::path& file, const Fill& fill);
void sync_disk_of(const std::filesystem::path& folder);

}  // namespace ir
