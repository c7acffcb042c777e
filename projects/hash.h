#pragma once

#include <filesystem>
#include <string>

#include "projects/json.h"
#include "renderers/core/hash.h"
#include "renderers/core/progress.h"

namespace ir::projects {

/// As hash_bytes() of a file's bytes, read in blocks. Throws InputError when it cannot be read, and
/// Cancelled between two blocks once that is asked for.
std::string hash_file(const std::filesystem::path& file, const CancelToken* cancel = nullptr);
/// Of the canonical text: neither the order of keys nor the layout matters.
std::string hash_json(const Json& json);

}  // namespace ir::projects
