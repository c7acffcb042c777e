#include "projects/scene_files.h"

#include <algorithm>
#include <optional>

#include "projects/hash.h"
#include "projects/hash_cache.h"
#include "renderers/core/error.h"
#include "renderers/core/named_files.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view builtin_prefix = "builtin:";

/// The hash of what a source contains now: empty when it is missing, nothing when it is not known.
std::optional<std::string> hash_now(const std::string& source, const fs::path& project_folder,
                                    const ContentHashes* known, const CancelToken* cancel = nullptr) {
    std::error_code ignored;
    if (!known || is_builtin(source)) {
        try {
            return scene_hash(source, project_folder, cancel);
        } catch (const InputError&) {
            return "";
        }
    }
    if (!fs::is_regular_file(resolve(source, project_folder), ignored)) return "";
    const auto found = known->find(source);
    // An empty hash of a file that is there now is one of an earlier look.
    if (found == known->end() || found->second.empty()) return std::nullopt;
    return found->second;
}

FileStatus status_of(const std::string& source, const std::string& recorded, const fs::path& project_folder,
                     const ContentHashes* known) {
    FileStatus result;
    result.source = source;
    if (!is_builtin(source)) result.resolved = resolve(source, project_folder);
    const auto hash = hash_now(source, project_folder, known);
    result.hash_now = hash.value_or("");
    if (!hash)
        result.state = FileState::unread;
    else if (hash->empty())
        result.state = FileState::missing;
    else if (recorded.empty())
        result.state = FileState::unhashed;
    else if (recorded != *hash)
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
    static constexpr std::array names{"ok", "missing", "changed", "not hashed yet", "not read yet"};
    return names.at(static_cast<std::size_t>(state));
}

std::set<std::string> sources_of(const Project& project) {
    std::set<std::string> sources;
    for_each_file(project, [&](const std::string& source, const std::string&) { sources.insert(source); });
    return sources;
}

bool is_builtin(const std::string& source) {
    return source.rfind(builtin_prefix, 0) == 0;
}

bool is_gltf_name(const fs::path& file) {
    auto extension = file.extension().string();
    for (auto& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension == ".gltf" || extension == ".glb";
}

bool names_scene(const std::string& given) {
    std::error_code ignored;
    return is_builtin(given) || (is_gltf_name(given) && !fs::is_directory(given, ignored));
}

fs::path resolve(const std::string& source, const fs::path& project_folder) {
    const fs::path path(source);
    if (path.is_absolute()) return path.lexically_normal();
    // A project that was never saved has no folder yet.
    const auto base = project_folder.empty() ? fs::current_path() : fs::absolute(project_folder);
    return (base / path).lexically_normal();
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
    for (const auto& reference : shared_hash_cache().references(file)) {
        const auto path = (file.parent_path() / reference).lexically_normal();
        if (std::find(files.begin(), files.end(), path) == files.end()) files.push_back(path);
    }
    return files;
}

std::vector<fs::path> files_outside(const Project& project, const fs::path& project_folder) {
    std::vector<fs::path> outside;
    for (const auto& source : sources_of(project)) {
        if (is_builtin(source)) continue;
        for (auto& file : files_of(resolve(source, project_folder)))
            if (!lies_within(file, project_folder)) outside.push_back(std::move(file));
    }
    return outside;
}

std::string scene_hash(const std::string& source, const fs::path& project_folder, const CancelToken* cancel) {
    if (is_builtin(source)) return hash_bytes(canonical_builtin(source));
    auto& cache = shared_hash_cache();
    const auto files = files_of(resolve(source, project_folder));
    const auto own = cache.hash(files.front(), cancel);
    if (files.size() == 1) return own;
    std::string all = own;
    for (std::size_t i = 1; i < files.size(); ++i) {
        std::error_code ignored;
        // A missing texture is a difference like any other; the loader says what it means.
        all += fs::is_regular_file(files[i], ignored) ? cache.hash(files[i], cancel) : std::string("missing");
    }
    return hash_bytes(all);
}

FileStatus status(const ScenePart& part, const fs::path& project_folder, const ContentHashes* known) {
    return status_of(part.source, part.content_hash, project_folder, known);
}

FileStatus status(const Environment& environment, const fs::path& project_folder,
                  const ContentHashes* known) {
    if (environment.kind != Environment::Kind::map) return {};
    return status_of(environment.source, environment.content_hash, project_folder, known);
}

FileStatus status(const ForeignImage& image, const fs::path& project_folder, const ContentHashes* known) {
    return status_of(image.source, image.content_hash, project_folder, known);
}

Scene located(const Scene& scene, std::size_t part, const fs::path& file, const fs::path& project_folder) {
    Scene result = scene;
    result.parts.at(part).source = relative_source(file, project_folder);
    return result;
}

Scene with_current_hashes(const Scene& scene, const fs::path& project_folder, const ContentHashes* known) {
    Scene result = scene;
    for (auto& part : result.parts) {
        const auto now = status(part, project_folder, known);
        if (!now.hash_now.empty()) part.content_hash = now.hash_now;
    }
    return result;
}

ContentHashes read_contents(const Project& project, const fs::path& project_folder,
                            const CancelToken* cancel) {
    ContentHashes known;
    for (const auto& source : sources_of(project))
        known[source] = hash_now(source, project_folder, nullptr, cancel).value_or("");
    return known;
}

Project with_contents(const Project& project, const ContentHashes& known) {
    Project result = project;
    for_each_file(result, [&](const std::string& source, std::string& hash) {
        const auto found = known.find(source);
        if (found != known.end() && !found->second.empty()) hash = found->second;
    });
    return result;
}

Project with_missing_hashes(const Project& project, const fs::path& project_folder,
                            const CancelToken* cancel) {
    Project result = project;
    record_missing_hashes(result, read_contents(project, project_folder, cancel));
    return result;
}

ContentHashes record_missing_hashes(Project& project, const ContentHashes& known) {
    ContentHashes recorded;
    for_each_file(project, [&](const std::string& source, std::string& hash) {
        const auto found = known.find(source);
        if (!hash.empty() || found == known.end() || found->second.empty()) return;
        hash = recorded[source] = found->second;
    });
    return recorded;
}

}  // namespace ir::projects
