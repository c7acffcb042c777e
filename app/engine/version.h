#pragma once

#include <string>

namespace ir::engine {

/// "0.1.0"
std::string version();
/// Of the sources: "0f78f8cb1234", "0f78f8cb1234-dirty" where they differ from it, "unknown" outside git.
std::string commit();
/// "0.1.0, commit 0f78f8cb1234"
std::string version_and_commit();
/// The compiler, and for what it built: "GNU 12.2.0 Release".
std::string build();
/// Quoted where a shell needs it.
std::string shell_word(const std::string& word);
/// Of this process, one shell_word() after another; empty: not known here.
std::string command_line();

}  // namespace ir::engine
