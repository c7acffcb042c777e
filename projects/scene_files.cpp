#include "projects/scene_files.h"

#include <algorithm>

#include "projects/gltf_references.h"
#include "projects/hash.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view builtin_prefix = "builtin:";

FileStatus status_of(const std::string& source, const std::string& recorded, const fs::path& project_folder) {
    FileStatus result;
    result.source = source;
    if (!is_builtin(source)) result.resolved = resolve(source, project_folder);
    try {
        result.hash_now = scene_hash(source, project_folder);
    } catch (const InputError&) {
        result.state = FileState::missing;
        return result;
    }
    if (recorded.empty())
        result.state = FileState::unhashed;
    else if (recorded != result.hash_now)
        result.state = FileState::changed;
    return result;
}

/// "builtin:NAME@VERSION?b=2&a=1" with its options in order: how they are written does not matter.
std::string canonical_builtin(const std::string& source) {
    const auto question = source.find('?');
    if (question == std::string::npos) return source;
    std::vector<std::string> options;
    std::size_t begin = question + 1;
    while (begin <= source.size()) {
        const auto end = std::min(source.find('&', begin), source.size());
        if (end > begin) options.push_back(source.substr(begin, end - begin));
        begin = end + 1;
    }
    std::sort(options.begin(), options.end());
    std::string result = source.substr(0, question);
    for (std::size_t i = 0; i < options.size(); ++i) result += (i == 0 ? "?" : "&") + options[i];
    return result;
}

}  // namespace

std::string to_string(FileState state) {
    static constexpr std::array names{"ok", "missing", "changed", "not hashed yet"};
    return names.at(static_cast<std::size_t>(state));
}

bool is_builtin(const std::string& source) {
    return source.rfind(builtin_prefix, 0) == 0;
}

fs::path resolve(const std::string& source, const fs::path& project_folder) {
    const fs::path path(source);
    return (path.is_absolute() ? path : fs::absolute(project_folder) / path).lexically_normal();
}

std::string relative_source(const fs::path& file, const fs::path& project_folder) {
    std::error_code error;
    const auto relative = fs::relative(file, project_folder, error);
    return error || relative.empty() ? fs::absolute(file).generic_string() : relative.generic_string();
}

std::string loadable_source(const std::string& source, const fs::path& project_folder) {
    return is_builtin(source) ? source : resolve(source, project_folder).string();
}

std::vector<fs::path> files_of(const fs::path& file) {
    std::vector<fs::path> files{file};
    for (const auto& reference : gltf_references(file)) {
        const auto path = (file.parent_path() / reference).lexically_normal();
        if (std::find(files.begin(), files.end(), path) == files.end()) files.push_back(path);
    }
    return files;
}

std::string scene_hash(const std::string& source, const fs::path& project_folder) {
    if (is_builtin(source)) return hash_bytes(canonical_builtin(source));
    const auto files = files_of(resolve(source, project_folder));
    const auto own = hash_file(files.front());
    if (files.size() == 1) return own;
    std::string all = own;
    for (std::size_t i = 1; i < files.size(); ++i) {
        std::error_code ignored;
        // A missing texture is a difference like any other; the loader says what it means.
        all += fs::is_regular_file(files[i], ignored) ? hash_file(files[i]) : std::string("missing");
    }
    return hash_bytes(all);
}

FileStatus status(const ScenePart& part, const fs::path& project_folder) {
    return status_of(part.source, part.content_hash, project_folder);
}

FileStatus status(const Environment& environment, const fs::path& project_folder) {
    if (environment.kind != Environment::Kind::map) return {};
    return status_of(environment.source, environment.content_hash, project_folder);
}

FileStatus status(const ForeignImage& image, const fs::path& project_folder) {
    return status_of(image.source, image.content_hash, project_folder);
}

Scene located(const Scene& scene, std::size_t part, const fs::path& file, const fs::path& project_folder) {
    Scene result = scene;
    result.parts.at(part).source = relative_source(file, project_folder);
    return result;
}

Scene with_current_hashes(const Scene& scene, const fs::path& project_folder) {
    Scene result = scene;
    for (auto& part : result.parts) {
        const auto now = status(part, project_folder);
        if (now.state != FileState::missing) part.content_hash = now.hash_now;
    }
    return result;
}

Project with_missing_hashes(const Project& project, const fs::path& project_folder) {
    Project result = project;
    const auto record = [&](const FileStatus& now, std::string& hash) {
        if (now.state == FileState::unhashed) hash = now.hash_now;
    };
    for (auto& scene : result.scenes)
        for (auto& part : scene.parts) record(status(part, project_folder), part.content_hash);
    for (auto& set : result.lights)
        record(status(set.environment, project_folder), set.environment.content_hash);
    for (auto& image : result.images) record(status(image, project_folder), image.content_hash);
    return result;
}

}  // namespace ir::projects
