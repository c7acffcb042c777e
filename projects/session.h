#pragma once

#include <filesystem>

#include "projects/json.h"
#include "renderers/core/file_system.h"

namespace ir::projects {

/// session.json: layout, zoom, pins. Free JSON of the window; neither undone nor dirty. A missing or damaged
/// file is an empty object: nothing of value is in it.
Json load_session(const std::filesystem::path& folder, FileSystem& files = real_file_system());
void save_session(const std::filesystem::path& folder, const Json& session,
                  FileSystem& files = real_file_system());

}  // namespace ir::projects
