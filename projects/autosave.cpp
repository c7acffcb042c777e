#include "projects/autosave.h"

#include "projects/hash.h"
#include "projects/object_reader.h"
#include "projects/store.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

/// An autosave holds a project one level deeper than a project file does.
constexpr JsonLimits autosave_limits{JsonLimits{}.bytes + 4096, JsonLimits{}.depth + 1,
                                     JsonLimits{}.keys_per_object};

std::string autosave_text(const Project& project, const std::string& base_hash) {
    return pretty_json(Json::object({{"base_hash", base_hash}, {"project", to_json(project)}}));
}

struct Autosave {
    std::string base_hash;
    Project project;
};

/// Throws InputError for a damaged one.
Autosave read_autosave(const fs::path& file, const Registry& registry, FileSystem& files) {
    const Json json = parse_json(files.read(file, autosave_limits.bytes), file.string(), autosave_limits);
    ObjectReader reader(json, file.string(), "");
    Autosave result;
    result.base_hash = reader.text("base_hash");
    const Json* project = reader.take("project");
    if (!project) reader.fail("project", "is missing");
    result.project = read_project(pretty_json(*project), file.string(), registry).project;
    return result;
}

}  // namespace

void write_autosave(const Project& project, const fs::path& folder, const std::string& base_hash,
                    FileSystem& files) {
    write_atomically(files, folder / autosave_file_name, autosave_text(project, base_hash));
}

void remove_autosave(const fs::path& folder, FileSystem& files) {
    files.remove(folder / autosave_file_name);
}

std::optional<Recovery> find_recovery(const fs::path& folder, const Registry& registry, FileSystem& files) {
    const auto file = folder / autosave_file_name;
    const auto saved_file = folder / project_file_name;
    try {
        if (!files.exists(file)) return std::nullopt;
        Autosave autosave = read_autosave(file, registry, files);
        if (files.exists(saved_file)) {
            const std::string saved = files.read(saved_file, JsonLimits{}.bytes);
            // Changes made from exactly this version are newer whatever the clocks say.
            const bool is_newer =
                autosave.base_hash == hash_bytes(saved) || files.modified(file) > files.modified(saved_file);
            if (!is_newer) return std::nullopt;
            if (read_project(saved, saved_file.string(), registry).project == autosave.project)
                return std::nullopt;
        }
        const auto count = autosave.project.experiments.size();
        return Recovery{std::move(autosave.project),
                        "Changes that were never saved are left from a session that ended early (" +
                            std::to_string(count) + (count == 1 ? " experiment" : " experiments") +
                            "); take them over?"};
    } catch (const Error&) {
        return std::nullopt;
    }
}

AutosaveThread::AutosaveThread(FileSystem& files) : files_(files), thread_([this] { run(); }) {}

AutosaveThread::~AutosaveThread() {
    {
        const std::lock_guard guard(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void AutosaveThread::request(const Project& project, const fs::path& folder, const std::string& base_hash) {
    std::string text = autosave_text(project, base_hash);
    {
        const std::lock_guard guard(mutex_);
        waiting_ = Job{folder, std::move(text)};
    }
    changed_.notify_all();
}

void AutosaveThread::discard(const fs::path& folder) {
    std::unique_lock guard(mutex_);
    waiting_.reset();
    changed_.wait(guard, [this] { return !writing_; });
    remove_autosave(folder, files_);
}

void AutosaveThread::flush() {
    std::unique_lock guard(mutex_);
    changed_.wait(guard, [this] { return !writing_ && !waiting_; });
}

std::string AutosaveThread::take_error() {
    const std::lock_guard guard(mutex_);
    return std::exchange(error_, {});
}

void AutosaveThread::run() {
    std::unique_lock guard(mutex_);
    while (true) {
        changed_.wait(guard, [this] { return stopping_ || waiting_; });
        if (stopping_) return;
        const Job job = std::move(*waiting_);
        waiting_.reset();
        writing_ = true;
        guard.unlock();
        std::string error;
        try {
            write_atomically(files_, job.folder / autosave_file_name, job.text);
        } catch (const std::exception& failure) {
            error = failure.what();
        }
        guard.lock();
        if (!error.empty()) error_ = error;
        writing_ = false;
        changed_.notify_all();
    }
}

}  // namespace ir::projects
