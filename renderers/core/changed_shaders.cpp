#include "renderers/core/changed_shaders.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "renderers/core/error.h"
#include "renderers/core/hash.h"
#include "renderers/core/line_diff.h"
#include "renderers/core/resources_path.h"

namespace ir {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> changes_allowed = false;
std::mutex folder_mutex;
fs::path used_folder;
std::optional<std::string> folder_digest;  ///< absent: not looked at yet

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    std::ifstream in(file, std::ios::binary);
    if (in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
    return text.str();
}

/// Whether it is "lib/random.glsl" and the like, and leads nowhere else.
bool is_shader_name(const std::string& file) {
    const fs::path path(file);
    if (file.size() > 200 || path.lexically_normal().generic_string() != file || !has_shader_ending(path))
        return false;
    const bool is_plain = std::all_of(file.begin(), file.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
               c == '_' || c == '.' || c == '/';
    });
    return is_plain && std::any_of(shader_folders.begin(), shader_folders.end(), [&](const char* folder) {
               return file.starts_with(std::string(folder) + "/");
           });
}

/// "lib/random.glsl" of "b/shaders/lib/random.glsl": the rest that is a shader of the program, else the
/// longest.
std::string shader_named_by(const fs::path& path) {
    constexpr std::size_t longest_path = 4096;  // each folder of it is tried as the first
    if (path.native().size() > longest_path) return {};
    std::string longest;
    for (auto begin = path.begin(); begin != path.end(); ++begin) {
        if (std::count(shader_folders.begin(), shader_folders.end(), begin->string()) == 0) continue;
        fs::path file;
        for (auto part = begin; part != path.end(); ++part) file /= *part;
        std::error_code ignored;
        if (fs::is_regular_file(shader_directory() / file, ignored)) return file.generic_string();
        if (longest.empty()) longest = file.generic_string();
    }
    return longest;
}

/// Of all that differs from the program's own shaders; empty: nothing.
std::string digest_of_folder(const fs::path& folder) {
    std::string all;
    const auto own = shader_directory();
    auto names = shaders_in(own);
    names.merge(shaders_in(folder));
    for (const auto& name : names) {
        const auto text = text_of(folder / name);
        if (text != text_of(own / name)) all += name + '\n' + hash_bytes(text) + '\n';
    }
    return all.empty() ? "" : hash_bytes(all);
}

/// Projects are JSON.
bool is_utf8(const std::string& text) {
    try {
        nlohmann::json(text).dump();
        return true;
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

}  // namespace

bool has_shader_ending(const fs::path& file) {
    static const std::set<std::string> endings{".glsl", ".vert", ".tesc", ".tese", ".geom", ".frag", ".comp"};
    return endings.count(file.extension().string()) != 0;
}

std::set<std::string> shaders_in(const fs::path& folder) {
    std::set<std::string> names;
    std::error_code error;
    for (const auto* part : shader_folders) {
        fs::recursive_directory_iterator entry(folder / part, error), end;
        for (; !error && entry != end; entry.increment(error))
            if (has_shader_ending(entry->path()))
                names.insert(entry->path().lexically_relative(folder).generic_string());
    }
    return names;
}

std::string problem_with_change(const std::string& file, const std::string& hunks) {
    if (!is_shader_name(file))
        return "is no file of the shader folder; name one as lib/…, passes/… or methods/…";
    if (hunks.empty()) return "changes nothing; leave it out";
    if (hunks.size() > most_hunk_bytes)
        return "is longer than " + std::to_string(most_hunk_bytes) + " bytes; change less of the file";
    if (!is_utf8(hunks)) return "has letters that are no UTF-8; save the file in that encoding";
    try {
        count_lines(hunks);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

ShaderChanges read_changes(const std::string& text) {
    ShaderChanges changes;
    for (auto& [name, hunks] : hunks_by_file(text)) {
        const auto file = shader_named_by(name);
        if (!hunks.ends_with('\n')) hunks += '\n';
        if (const auto problem = problem_with_change(file, hunks); !problem.empty())
            throw Error(name + ": " + problem);
        if (!changes.emplace(file, std::move(hunks)).second)
            throw Error(file + " stands there twice; give the changes of one folder of shaders");
    }
    if (changes.empty()) throw Error("no shader is changed; give what `git diff` or `diff -ru` writes");
    return changes;
}

std::string changed_shader(const fs::path& folder, const std::string& file, const std::string& hunks) {
    std::error_code ignored;
    if (!fs::is_regular_file(folder / file, ignored))
        throw Error(file + ": its change is of a shader that is not there (any more); remove the change");
    try {
        return apply_line_diff(text_of(folder / file), hunks);
    } catch (const Error& error) {
        throw Error(file + ": its change does not fit the shader (any more): " + error.what() +
                    "; edit the copy again, or remove the change");
    }
}

std::string change_text(const std::string& hunks) {
    return count_lines(hunks).text() + ", " + hash_bytes(hunks);
}

std::string digest_of(const ShaderChanges& changes) {
    if (changes.empty()) return {};
    std::string all;
    for (const auto& [file, hunks] : changes) all += file + '\n' + hash_bytes(hunks) + '\n';
    return hash_bytes(all);
}

void use_shaders_of(const fs::path& folder) {
    const std::lock_guard lock(folder_mutex);
    used_folder = folder;
    folder_digest.reset();
}

void look_at_shaders_again() {
    const auto folder = [] {
        const std::lock_guard lock(folder_mutex);
        return used_folder;
    }();
    if (folder.empty()) return;
    auto digest = digest_of_folder(folder);
    const std::lock_guard lock(folder_mutex);
    if (used_folder == folder) folder_digest = std::move(digest);
}

std::string shader_folder_digest() {
    const auto is_known = [] {
        const std::lock_guard lock(folder_mutex);
        return used_folder.empty() || folder_digest;
    }();
    if (!is_known) look_at_shaders_again();
    const std::lock_guard lock(folder_mutex);
    return folder_digest.value_or("");
}

void allow_changed_shaders() {
    changes_allowed = true;
}
bool are_changed_shaders_allowed() {
    return changes_allowed;
}

}  // namespace ir
