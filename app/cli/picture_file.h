#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/engine/execution.h"

namespace ir::cli {

/// Before work whose picture goes to --out: throws UsageError for a file that is no .exr or .png, for a .png
/// that cannot hold `dumps`, and where its folder is missing.
void require_picture(const std::string& file, const std::vector<std::string>& dumps);

/// The main result and the layers that match `dumps` with all attributes as .exr, or the main result as
/// .png, as screens show it. Throws Error.
void write_picture(const std::filesystem::path& file, const engine::Execution& execution,
                   const std::vector<std::string>& dumps);

}  // namespace ir::cli
