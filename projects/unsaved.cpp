#include "projects/unsaved.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <system_error>

#include "projects/autosave.h"
#include "projects/scene_files.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

/// "20240501120000"
std::string digits_of_now() {
    std::string digits;
    for (const char c : utc_now())
        if (std::isdigit(static_cast<unsigned char>(c))) digits += c;
    return digits;
}

fs::path free_folder(const fs::path& place, const std::string& name, FileSystem& files) {
    const auto stem = free_id(name, {}) + "-" + std::to_string(::getpid()) + "-" + digits_of_now();
    for (int i = 1;; ++i) {
        auto folder = place / (stem + (i == 1 ? "" : "-" + std::to_string(i)) + folder_suffix);
        if (!files.exists(folder)) return folder;
    }
}

/// The autosave, or what a write of it left behind.
bool is_of_autosave(const fs::path& name) {
    return name.string().rfind(autosave_file_name, 0) == 0;
}

}  // namespace

UnsavedHome UnsavedHome::make(const fs::path& place, const std::string& name, FileSystem& files) {
    UnsavedHome home;
    home.folder_ = free_folder(place, name, files);
    files.create_directories(home.folder_);
    home.lock_ = Lock::acquire(home.folder_);
    if (!home.lock_.is_held())
        throw Error(home.folder_.string() + ": cannot be autosaved there: " + home.lock_.reason());
    return home;
}

UnsavedHome UnsavedHome::take_over(const fs::path& folder, FileSystem& files) {
    if (!is_unsaved(folder, files))
        throw InputError(folder.string(), "", "holds no project that was never saved");
    UnsavedHome home;
    home.folder_ = folder;
    home.lock_ = Lock::acquire(folder);
    if (!home.lock_.is_held()) throw Error(folder.string() + ": " + home.lock_.reason());
    return home;
}

void UnsavedHome::remove(FileSystem& files) {
    if (lock_.is_still_ours(files)) {
        for (const auto& name : files.list(folder_))
            if (is_of_autosave(name)) files.remove(folder_ / name);
        lock_.release();
        // Only when it is empty: nothing that somebody put there goes with it.
        std::error_code ignored;
        fs::remove(folder_, ignored);
    }
    *this = {};
}

bool is_unsaved(const fs::path& folder, FileSystem& files) {
    if (!files.exists(folder / autosave_file_name)) return false;
    const auto names = files.list(folder);
    return std::all_of(names.begin(), names.end(), [](const fs::path& name) {
        return is_of_autosave(name) || name.string().rfind(".lock", 0) == 0;
    });
}

std::vector<UnsavedProject> find_unsaved(const fs::path& place, const Registry& registry, FileSystem& files) {
    std::vector<UnsavedProject> found;
    for (const auto& file : files.list(place)) {
        const auto parent = file.parent_path();
        if (file.filename() != autosave_file_name || parent.empty() || parent.has_parent_path()) continue;
        const auto folder = place / parent;
        if (!is_unsaved(folder, files) || !Lock::is_free(folder)) continue;
        const auto recovery = find_recovery(folder, registry, files);
        if (recovery) found.push_back({folder, recovery->project.name, files.modified(place / file)});
    }
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.modified > b.modified; });
    return found;
}

Project with_absolute_sources(const Project& project, const fs::path& project_folder) {
    Project result = project;
    const auto move = [&](std::string& source) {
        if (!source.empty()) source = loadable_source(source, project_folder);
    };
    for (auto& scene : result.scenes)
        for (auto& part : scene.parts) move(part.source);
    for (auto& set : result.lights) move(set.environment.source);
    for (auto& image : result.images) move(image.source);
    return result;
}

}  // namespace ir::projects
