#include "projects/store.h"

#include <string>

#include "projects/hash.h"
#include "projects/lock.h"
#include "projects/scene_files.h"
#include "projects/sweep.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

std::string read_bytes(const fs::path& file, FileSystem& files) {
    return files.read(file, JsonLimits{}.bytes);
}

/// The version on disk stays as project.json.previous. A copy and not a link: works on every file system.
void keep_previous(const fs::path& folder, const std::string& bytes, FileSystem& files) {
    write_atomically(files, folder / previous_file_name, bytes);
}

LastKept read_last_kept(const fs::path& folder, FileSystem& files) {
    try {
        return ResultIndex::load(folder, files).last_kept();
    } catch (const InputError&) {
        return {};  // a damaged index keeps nobody from opening the project; --check names it
    }
}

fs::path place_of(const fs::path& file) {
    std::error_code ignored;
    auto result = fs::weakly_canonical(fs::absolute(file), ignored);
    return ignored ? fs::absolute(file).lexically_normal() : result;
}

constexpr const char* session_file_name = "session.json";

}  // namespace

fs::path folder_with_suffix(const fs::path& given) {
    auto path = given;
    if (path.filename().empty()) path = path.parent_path();
    return path.extension() == folder_suffix ? path : fs::path(path.string() + folder_suffix);
}

fs::path project_folder(const fs::path& given) {
    std::error_code ignored;
    const bool is_file = given.filename() == project_file_name && !fs::is_directory(given, ignored);
    fs::path folder = is_file ? given.parent_path() : given;
    if (folder.empty()) folder = ".";
    if (!fs::is_directory(folder, ignored))
        throw InputError(given.string(), "",
                         "is no project; give a folder NAME.interreflect or the project.json inside it");
    if (!fs::exists(folder / project_file_name, ignored)) {
        const bool has_previous = fs::exists(folder / previous_file_name, ignored);
        throw InputError(folder.string(), "",
                         std::string("holds no project.json") +
                             (has_previous ? "; rename its project.json.previous to restore it"
                                           : "; give the folder of a project"));
    }
    return folder;
}

LoadedProject load_project(const fs::path& given, const Registry& registry, FileSystem& files) {
    LoadedProject loaded;
    // The check of the folder looks at the machine's own files; other file systems are given a folder.
    loaded.folder = &files == &real_file_system() ? project_folder(given) : given;
    const auto file = loaded.folder / project_file_name;
    const std::string bytes = read_bytes(file, files);
    try {
        static_cast<ReadProject&>(loaded) = read_project(bytes, file.string(), registry);
    } catch (const InputError& error) {
        const bool has_previous = files.exists(loaded.folder / previous_file_name);
        const bool has_autosave = files.exists(loaded.folder / autosave_file_name);
        if (!has_previous && !has_autosave) throw;
        std::string left = has_previous ? std::string("the version before is in ") + previous_file_name : "";
        if (has_autosave)
            left += (left.empty() ? "" : ", ") + std::string("unsaved changes are in ") + autosave_file_name;
        throw InputError(error.what(), "", left);
    }
    loaded.file_hash = hash_bytes(bytes);
    loaded.last_kept = read_last_kept(loaded.folder, files);
    tell_last_kept(loaded.project, loaded.last_kept);
    return loaded;
}

std::string save_project(const Project& project, const fs::path& folder, const std::string& expected_hash,
                         FileSystem& files) {
    const std::string text = write_project(project);
    if (text.size() > JsonLimits{}.bytes)
        throw Error(folder.string() + ": the project has grown beyond " + std::to_string(JsonLimits{}.bytes) +
                    " bytes; shorten its notes or split it");
    const auto file = folder / project_file_name;
    parse_json(text, file.string());  // what could not be read again is never written
    const auto new_hash = hash_bytes(text);
    files.create_directories(folder);
    if (files.exists(file)) {
        const std::string on_disk = read_bytes(file, files);
        const auto disk_hash = hash_bytes(on_disk);
        if (disk_hash == new_hash) return new_hash;
        if (!expected_hash.empty() && disk_hash != expected_hash)
            throw ChangedOnDisk(file.string() + ": was changed by somebody else since it was opened; " +
                                "save under another name, or overwrite it");
        keep_previous(folder, on_disk, files);
    }
    write_atomically(files, file, text);
    return new_hash;
}

std::vector<Message> upgrade_project(const fs::path& given, const Registry& registry, FileSystem& files,
                                     const CancelToken* cancel) {
    const auto lock = Lock::acquire(project_folder(given));
    if (!lock.is_held()) throw Error(given.string() + ": cannot be upgraded: " + lock.reason());
    auto loaded = load_project(given, registry, files);
    for (auto& experiment : loaded.project.experiments) {
        const auto* method = registry.find(experiment.method);
        if (!method || method->version <= experiment.method_version) continue;
        loaded.messages.push_back({Severity::note, "project",
                                   "experiment '" + experiment.id + "': " + method->id + " from version " +
                                       std::to_string(experiment.method_version) + " to " +
                                       std::to_string(method->version)});
        experiment.method_version = method->version;
    }
    auto hashed = with_missing_hashes(loaded.project, loaded.folder, cancel);
    if (hashed != loaded.project)
        loaded.messages.push_back({Severity::note, "project", "recorded the hashes of files that had none"});
    save_project(hashed, loaded.folder, loaded.file_hash, files);
    return loaded.messages;
}

bool is_own_file(const LoadedProject& loaded, const fs::path& file) {
    const auto target = place_of(file);
    const auto inside = target.lexically_relative(place_of(loaded.folder));
    const auto first = inside.empty() ? std::string("..") : inside.begin()->string();
    const auto begins_with = [&](const char* name) { return first.starts_with(name); };
    if (begins_with("project.json") || begins_with("session.json")) return true;
    if (first == "results") return !inside.generic_string().starts_with("results/" + sweep_path(""));
    for (const auto& source : sources_of(loaded.project)) {
        if (is_builtin(source)) continue;
        for (const auto& one : files_of(resolve(source, loaded.folder)))
            if (place_of(one) == target) return true;
    }
    return false;
}

Json load_session(const std::filesystem::path& folder, FileSystem& files) {
    const auto file = folder / session_file_name;
    try {
        if (!files.exists(file)) return Json::object();
        Json session = parse_json(files.read(file, JsonLimits{}.bytes), file.string());
        return session.is_object() ? session : Json::object();
    } catch (const Error&) {
        return Json::object();
    }
}

void save_session(const std::filesystem::path& folder, const Json& session, FileSystem& files) {
    write_atomically(files, folder / session_file_name, pretty_json(session));
}

}  // namespace ir::projects
