#include "projects/own_files.h"

#include <string>

#include "projects/scene_files.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

fs::path place_of(const fs::path& file) {
    std::error_code ignored;
    auto result = fs::weakly_canonical(fs::absolute(file), ignored);
    return ignored ? fs::absolute(file).lexically_normal() : result;
}

}  // namespace

bool is_own_file(const LoadedProject& loaded, const fs::path& file) {
    const auto target = place_of(file);
    const auto inside = target.lexically_relative(place_of(loaded.folder));
    const auto first = inside.empty() ? std::string("..") : inside.begin()->string();
    const auto begins_with = [&](const char* name) { return first.starts_with(name); };
    if (begins_with("project.json") || begins_with("session.json") || first == "results") return true;
    for (const auto& source : sources_of(loaded.project)) {
        if (is_builtin(source)) continue;
        for (const auto& one : files_of(resolve(source, loaded.folder)))
            if (place_of(one) == target) return true;
    }
    return false;
}

}  // namespace ir::projects
