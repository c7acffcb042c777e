#pragma once

#include "renderers/core/file_system.h"

/// How results get to where a person wants them: pictures, tables, statistics, archives.
namespace ir {

/// Writes atomically, behind all links, also those to what is not there yet. Devices, pipes and open
/// descriptors (/dev/stdout) take the bytes themselves and stay what they are. Throws Error.
void write_file(const std::filesystem::path& file, const Fill& fill);
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// What write_file would write, behind all links. Throws Error where that can be no file: a folder, a disk,
/// links in a circle.
std::filesystem::path behind_links(const std::filesystem::path& file);

}  // namespace ir
