#include "projects/sample_copy.h"

#include <unistd.h>

#include "projects/edits.h"
#include "projects/hash.h"
#include "projects/json.h"
#include "projects/lock.h"
#include "projects/scene_files.h"
#include "projects/store.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

/// In a copy: hashes of the sample as it was copied, and of what may be changed in the copy as it was made.
constexpr const char* origin_file_name = "sample.json";

/// What the copy has in common with the sample: neither locks nor what somebody worked on there.
std::vector<fs::path> files_of_sample(const fs::path& sample, FileSystem& files) {
    auto list = files.list(sample);
    std::erase_if(list, [](const fs::path& file) {
        return file.native().front() == '.' || file.extension() == temporary_extension ||
               file == previous_file_name || file == autosave_file_name;
    });
    return list;
}

std::string hash_of_sample(const fs::path& sample, FileSystem& files) {
    std::string all;
    for (const auto& file : files_of_sample(sample, files))
        all += file.generic_string() + '\n' + hash_file(sample / file) + '\n';
    return hash_bytes(all);
}

/// The document and what was kept: neither is changed by looking at pictures.
std::string hash_of_work(const fs::path& folder, FileSystem& files) {
    std::string all = files.read(folder / project_file_name, JsonLimits{}.bytes);
    for (const auto& file : files.list(folder / "results")) all += '\n' + file.generic_string();
    return hash_bytes(all);
}

/// A member of the copy's origin; empty where it has none.
std::string origin_of(const fs::path& copy, const char* member, FileSystem& files) {
    const auto file = copy / origin_file_name;
    try {
        const Json origin = parse_json(files.read(file, JsonLimits{}.bytes), file.string());
        const auto found = origin.is_object() ? origin.find(member) : origin.end();
        return found != origin.end() && found->is_string() ? found->get<std::string>() : std::string();
    } catch (const Error&) {
        return {};
    }
}

bool is_changed(const fs::path& copy, FileSystem& files) {
    return origin_of(copy, "work", files) != hash_of_work(copy, files) ||
           files.exists(copy / autosave_file_name);
}

/// Sources that lead out of the sample's folder would lead elsewhere from the copy's.
void keep_sources(const fs::path& sample, const fs::path& copy, const Registry& registry, FileSystem& files) {
    auto project = load_project(sample, registry, files).project;
    std::map<std::string, std::string> moved;
    for (const auto& source : sources_of(project))
        if (!is_builtin(source) && !files.exists(resolve(source, copy)))
            moved[source] = resolve(source, sample).generic_string();
    if (moved.empty()) return;
    edits::relocate(project, moved)->apply(project);
    write_atomically(files, copy / project_file_name, write_project(project));
}

void make_copy(const fs::path& sample, const fs::path& copy, const Registry& registry, FileSystem& files) {
    // Whole or not at all, and whoever else makes one at the same time makes the same.
    const auto begun =
        copy.parent_path() / ("." + copy.stem().string() + "-" + std::to_string(::getpid()) + folder_suffix);
    try {
        files.remove_all(begun);
        files.create_directories(begun);
        for (const auto& file : files_of_sample(sample, files))
            copy_atomically(files, sample / file, begun / file);
        keep_sources(sample, begun, registry, files);
        const Json origin = {{"sample", hash_of_sample(sample, files)}, {"work", hash_of_work(begun, files)}};
        write_atomically(files, begun / origin_file_name, pretty_json(origin));
        files.remove_all(copy);
        files.rename(begun, copy);
    } catch (const Error&) {
        files.remove_all(begun);
        throw;
    }
}

}  // namespace

SampleCopy copy_of_sample(const fs::path& sample, const fs::path& place, const Registry& registry,
                          FileSystem& files) {
    auto from = project_folder(fs::absolute(sample).lexically_normal());
    if (from.filename().empty()) from = from.parent_path();
    SampleCopy copy{place / from.filename()};
    const bool is_there = files.exists(copy.folder / project_file_name);
    copy.is_changed = is_there && is_changed(copy.folder, files);
    copy.is_outdated = is_there && origin_of(copy.folder, "sample", files) != hash_of_sample(from, files);
    const bool follows = copy.is_outdated && !copy.is_changed && Lock::is_free(copy.folder);
    if (is_there && !follows) return copy;
    make_copy(from, copy.folder, registry, files);
    copy.is_outdated = false;
    return copy;
}

fs::path place_aside(const SampleCopy& copy, FileSystem& files) {
    for (int number = 2;; ++number) {
        const auto aside =
            copy.folder.parent_path() /
            (copy.folder.stem().string() + "-" + std::to_string(number) + copy.folder.extension().string());
        if (!files.exists(aside)) return aside;
    }
}

fs::path put_aside(const SampleCopy& copy, FileSystem& files) {
    if (!Lock::is_free(copy.folder)) throw Error(copy.folder.string() + ": another process has it open");
    const auto aside = place_aside(copy, files);
    files.rename(copy.folder, aside);
    return aside;
}

}  // namespace ir::projects
