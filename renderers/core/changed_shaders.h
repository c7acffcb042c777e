#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>

/// Shaders that are others than the program's own.
namespace ir {

/// By file of the shader folder, such as "methods/hbao/march.comp": hunks (line_diff.h) that change its text.
using ShaderChanges = std::map<std::string, std::string>;

/// What a shader folder has.
inline constexpr std::array shader_folders{"lib", "passes", "methods"};
/// Whether a file's name ends as those of shaders do.
bool has_shader_ending(const std::filesystem::path& file);
/// Names of all files of a shader folder, in order.
std::set<std::string> shaders_in(const std::filesystem::path& folder);
/// What is wrong with a file's name and its change; empty: nothing. Documents of others name no file outside
/// of the shader folder.
std::string problem_with_change(const std::string& file, const std::string& hunks);
inline constexpr std::size_t most_changed_shaders = 32;
inline constexpr std::size_t most_hunk_bytes = 256 * 1024;  ///< of a file

/// Of a `git diff` or `diff -ru` of shader folders, whatever these are called: the changes by file. Throws
/// Error.
ShaderChanges read_changes(const std::string& text);

/// The file of the shader folder, changed. Throws Error where it cannot be read or its change does not fit.
std::string changed_shader(const std::filesystem::path& folder, const std::string& file,
                           const std::string& hunks);
/// "+3 −1" and a hash of the change.
std::string change_text(const std::string& hunks);
/// Of all of them, empty where there are none.
std::string digest_of(const ShaderChanges& changes);

/// Says that machines of this process take shaders from another folder, which is not looked at yet.
void use_shaders_of(const std::filesystem::path& folder);
/// Its files may be others than before.
void look_at_shaders_again();
/// Of all that differs in that folder from the program's own shaders; empty: nothing.
std::string shader_folder_digest();

/// What a person answers who started the program: changes of others' projects may run.
void allow_changed_shaders();
bool are_changed_shaders_allowed();

}  // namespace ir
