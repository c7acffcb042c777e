#pragma once

#include <filesystem>
#include <vector>

#include "projects/document_json.h"
#include "renderers/core/progress.h"
#include "renderers/core/report.h"

namespace ir::projects {

/// Writes one file that a colleague can open: an uncompressed tar archive (any tar program reads it) with
/// the document, its scene files, maps and images, and kept results. Sources are rewritten to the copies
/// inside. Equal projects give equal bytes. Returns what could not be packed (missing files). Throws Error,
/// and Cancelled between two blocks of a file.
std::vector<Message> pack_project(const std::filesystem::path& given, const std::filesystem::path& file,
                                  const Registry& registry, const CancelToken* cancel = nullptr);

/// Unpacks into a new folder NAME.interreflect inside `parent`, whole or not at all, and returns it; the
/// archive may be compressed. Throws InputError for a damaged or hostile archive and for a project that names
/// files outside of its folder, unless they are allowed, Error when the folder exists already, and Cancelled;
/// then nothing is left behind.
std::filesystem::path unpack_project(const std::filesystem::path& file, const std::filesystem::path& parent,
                                     const CancelToken* cancel = nullptr);

}  // namespace ir::projects
