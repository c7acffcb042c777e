#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "projects/results.h"

namespace ir::projects {

inline constexpr const char* results_guard_name = ".guard";

/// The right to change results/ of a project, for as long as this lives: file .guard in it, locked. Waits for
/// whoever has it, another thread or process; a project's window and a command may keep results at the same
/// time, and neither loses the other's.
class ResultsGuard {
  public:
    /// Makes results/ where it is missing. Throws Error where it cannot be written, or where a link to a
    /// folder in it leads out of it.
    explicit ResultsGuard(const std::filesystem::path& project_folder);
    ~ResultsGuard();
    ResultsGuard(const ResultsGuard&) = delete;
    ResultsGuard& operator=(const ResultsGuard&) = delete;

    /// False where the file system refuses to lock files: then nobody waits. Some lock them on one computer
    /// only (NFS mounted with local_lock, Lustre with localflock), and nothing tells.
    bool is_guarding() const { return is_guarding_; }

  private:
    int descriptor_;
    bool is_guarding_;
};

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

/// Removes results and their files for good; files that another result names, too, stay. The index is saved
/// first: whatever interrupts it, no listed file is gone. Keys that the index does not have are passed over.
/// Waits for others that change results/ (ResultsGuard). Throws Error.
Pruned delete_results(const std::filesystem::path& project_folder, const std::vector<std::string>& keys,
                      FileSystem& files = real_file_system());

}  // namespace ir::projects
