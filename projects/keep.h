#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "projects/results.h"
#include "projects/results_guard.h"

namespace ir::projects {

/// Of what else is in use when a result of the experiment `kept` is: keys of the last kept results of all
/// others, and of the pictures that the saved document asks for. Nobody's unsaved changes may take away what
/// that one needs.
std::set<std::string> keys_in_use(const ResultIndex& index, const std::string& kept,
                                  const std::filesystem::path& project_folder, const Registry& registry);

/// Lists a result whose files are in place; the guard must have been taken before they were written. It
/// becomes the last of its experiment, unless that is the same picture with more samples and `in_use` does
/// not have the key of the new one. Of results with the same state key and fewer samples the states go, and
/// the whole results where `in_use` does not have their key. The index is saved first, files are removed
/// after: whatever interrupts it, every listed file is there.
void keep(const std::filesystem::path& project_folder, KeptResult result, const std::set<std::string>& in_use,
          const ResultsGuard& guard, FileSystem& files = real_file_system());

}  // namespace ir::projects
