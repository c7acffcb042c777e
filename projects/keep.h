#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "projects/results.h"
#include "projects/results_guard.h"

namespace ir::projects {

/// Keys of kept results that a document names, and those that project.json on the disk names: nobody's
/// unsaved changes may take away what the saved document needs.
std::set<std::string> keys_in_use(const Project& project, const std::filesystem::path& project_folder,
                                  FileSystem& files = real_file_system());

/// Lists a result whose files are in place; the guard must have been taken before they were written. Of
/// results with the same state key and fewer samples the states go, and the whole results where `in_use` does
/// not have their key. The index is saved first, files are removed after: whatever interrupts it, every
/// listed file is there.
void keep(const std::filesystem::path& project_folder, KeptResult result, const std::set<std::string>& in_use,
          const ResultsGuard& guard, FileSystem& files = real_file_system());

}  // namespace ir::projects
