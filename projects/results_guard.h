#pragma once

#include <filesystem>

namespace ir::projects {

inline constexpr const char* results_guard_name = ".guard";

/// The right to change results/ of a project, for as long as this lives: file .guard in it, locked. Waits for
/// whoever has it, another thread or process; a project's window and a command may keep results at the same
/// time, and neither loses the other's.
class ResultsGuard {
  public:
    /// Makes results/ where it is missing. Throws Error where it cannot be written.
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

}  // namespace ir::projects
