#pragma once

#include <filesystem>
#include <vector>

#include "projects/results.h"

namespace ir::projects {

/// Removes results and their files for good; files that another result names, too, stay. The index is saved
/// first: whatever interrupts it, no listed file is gone. Keys that the index does not have are passed over.
/// Waits for others that change results/ (results_guard.h). Throws Error.
Pruned delete_results(const std::filesystem::path& project_folder, const std::vector<std::string>& keys,
                      FileSystem& files = real_file_system());

}  // namespace ir::projects
