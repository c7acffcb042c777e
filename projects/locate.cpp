#include <algorithm>

#include "projects/scene_files.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_entries = 100'000;

std::size_t length(const fs::path& path) {
    return static_cast<std::size_t>(std::distance(path.begin(), path.end()));
}

/// How many components, from the end, are the same.
std::size_t shared_end(const fs::path& a, const fs::path& b) {
    std::size_t count = 0;
    auto in_a = a.end(), in_b = b.end();
    while (in_a != a.begin() && in_b != b.begin() && *--in_a == *--in_b) ++count;
    return count;
}

/// Files below `folder` by their names.
std::multimap<std::string, fs::path> files_below(const fs::path& folder, const std::set<std::string>& names) {
    std::multimap<std::string, fs::path> found;
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
    for (std::size_t seen = 0; !error && entry != end && seen < max_entries; ++seen) {
        const auto name = entry->path().filename().string();
        std::error_code ignored;
        if (names.count(name) != 0 && entry->is_regular_file(ignored)) found.emplace(name, entry->path());
        entry.increment(error);
    }
    return found;
}

}  // namespace

std::map<std::string, std::string> locate_in(const Project& project, const fs::path& folder,
                                             const fs::path& project_folder) {
    std::set<std::string> missing, names;
    for (const auto& source : sources_of(project)) {
        std::error_code ignored;
        if (is_builtin(source) || fs::is_regular_file(resolve(source, project_folder), ignored)) continue;
        missing.insert(source);
        names.insert(fs::path(source).filename().string());
    }
    std::map<std::string, std::string> located;
    if (missing.empty()) return located;
    const auto found = files_below(fs::absolute(folder).lexically_normal(), names);
    for (const auto& source : missing) {
        const auto [first, last] = found.equal_range(fs::path(source).filename().string());
        const auto is_better = [&](const auto& a, const auto& b) {
            const auto shared_a = shared_end(a.second, source), shared_b = shared_end(b.second, source);
            if (shared_a != shared_b) return shared_a > shared_b;
            return std::pair(length(a.second), a.second) < std::pair(length(b.second), b.second);
        };
        const auto best = std::min_element(first, last, is_better);
        if (best != last) located[source] = relative_source(best->second, project_folder);
    }
    return located;
}

}  // namespace ir::projects
