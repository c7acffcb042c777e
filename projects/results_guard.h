#pragma once

#include <filesystem>

namespace ir::projects {

inline constexpr const char* results_guard_name = ".guard";

/// The right to change results/ of a project, for as long as this lives: file .guard in it, locked. Waits for
/// whoever has it, another thread or process; a project's window and a command may keep results at the same
/// time, and neither loses the other's. Where files cannot be locked (some network file systems), or the
/// folder cannot be written, it guards nothing.
class ResultsGuard {
  public:
    /// Makes results/ where it is missing.
    explicit ResultsGuard(const std::filesystem::path& project_folder);
    ~ResultsGuard();
    ResultsGuard(const ResultsGuard&) = delete;
    ResultsGuard& operator=(const ResultsGuard&) = delete;

  private:
    int descriptor_;
};

}  // namespace ir::projects
