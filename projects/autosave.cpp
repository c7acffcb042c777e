#include "projects/autosave.h"

#include <algorithm>
#include <utility>

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

std::string autosave_text(const Project& project, const std::string& base_hash,
                          const std::vector<fs::path>& contains) {
    Json names = Json::array();
    for (const auto& file : contains) names.push_back(file.filename().string());
    return pretty_json(
        Json::object({{"base_hash", base_hash}, {"contains", names}, {"project", to_json(project)}}));
}

struct Autosave {
    std::string base_hash;
    std::vector<std::string> contains;  ///< names of recoveries that the project has taken over
    Project project;
};

/// Throws InputError for a damaged one.
Autosave read_autosave(const fs::path& file, const Registry& registry, FileSystem& files) {
    const Json json = parse_json(files.read(file, autosave_limits.bytes), file.string(), autosave_limits);
    ObjectReader reader(json, file.string(), "");
    Autosave result;
    result.base_hash = reader.text("base_hash");
    reader.each("contains", [&](const Json& name, const std::string& pointer) {
        if (!name.is_string()) throw InputError(file.string(), pointer, "must be a text in quotes");
        result.contains.push_back(name.get<std::string>());
    });
    const Json* project = reader.take("project");
    if (!project) reader.fail("project", "is missing");
    result.project = read_project(pretty_json(*project), file.string(), registry).project;
    return result;
}

Recovery recovery_of(Project project, const fs::path& file) {
    const auto count = project.experiments.size();
    return {std::move(project),
            "Changes that were never saved are left from a session that ended early (" +
                std::to_string(count) + (count == 1 ? " experiment" : " experiments") + "); take them over?",
            file};
}

/// More crashes in a row without a decision are not expected.
constexpr int max_aside = 99;

fs::path aside_file(const fs::path& folder, int number) {
    return folder / ("project.json.recovery-" + std::to_string(number));
}

/// The number of the newest recovery that was put aside, or 0.
int newest_aside(const fs::path& folder, FileSystem& files) {
    int newest = max_aside;
    while (newest > 0 && !files.exists(aside_file(folder, newest))) --newest;
    return newest;
}

/// Removes the recoveries that a newer one contains.
void remove_contained(const fs::path& newer, const fs::path& folder, const Registry& registry,
                      FileSystem& files) {
    const auto contained = read_autosave(newer, registry, files).contains;
    for (int number = 1; number <= max_aside; ++number) {
        const auto file = aside_file(folder, number);
        if (file != newer &&
            std::find(contained.begin(), contained.end(), file.filename()) != contained.end())
            files.remove(file);
    }
}

/// Nothing when it is damaged or no longer differs from what is saved (then it goes).
std::optional<Recovery> read_aside(const fs::path& file, const fs::path& folder, const Registry& registry,
                                   FileSystem& files) {
    try {
        if (!files.exists(file)) return std::nullopt;
        auto autosave = read_autosave(file, registry, files);
        const auto saved_file = folder / project_file_name;
        const auto saved = files.read(saved_file, JsonLimits{}.bytes);
        if (read_project(saved, saved_file.string(), registry).project != autosave.project)
            return recovery_of(std::move(autosave.project), file);
        files.remove(file);
    } catch (const Error&) {
        // Damaged ones are left for people to look at.
    }
    return std::nullopt;
}

}  // namespace

void write_autosave(const Project& project, const fs::path& folder, const std::string& base_hash,
                    FileSystem& files) {
    write_atomically(files, folder / autosave_file_name, autosave_text(project, base_hash, {}));
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
            // What was made from exactly this version is newer, whatever the clocks say. What was made from
            // the version before may be older: a session that was killed while it saved had saved it, too. Of
            // any other version nobody knows.
            const auto previous = folder / previous_file_name;
            const bool may_be_older =
                autosave.base_hash != hash_bytes(saved) && files.exists(previous) &&
                autosave.base_hash == hash_bytes(files.read(previous, JsonLimits{}.bytes));
            if (may_be_older && files.modified(file) <= files.modified(saved_file)) return std::nullopt;
            if (read_project(saved, saved_file.string(), registry).project == autosave.project)
                return std::nullopt;
        }
        return recovery_of(std::move(autosave.project), file);
    } catch (const Error&) {
        return std::nullopt;
    }
}

fs::path put_autosave_aside(const fs::path& folder, FileSystem& files) {
    const int newest = newest_aside(folder, files);
    if (newest == max_aside)
        throw Error(folder.string() + ": holds too many recoveries; take or discard them");
    auto aside = aside_file(folder, newest + 1);
    files.rename(folder / autosave_file_name, aside);
    try {
        files.sync_directory(folder);
    } catch (const Error&) {
        // Under either name it will be found.
    }
    return aside;
}

std::vector<Recovery> collect_recoveries(const fs::path& folder, const Registry& registry,
                                         FileSystem& files) {
    std::vector<Recovery> result;
    int newest = newest_aside(folder, files);
    if (auto found = find_recovery(folder, registry, files)) {
        try {
            found->file = put_autosave_aside(folder, files);
            remove_contained(found->file, folder, registry, files);
        } catch (const Error&) {
            // What could not be moved or removed is offered where it is.
        }
        result.push_back(std::move(*found));
    }
    for (; newest > 0; --newest)
        if (auto found = read_aside(aside_file(folder, newest), folder, registry, files))
            result.push_back(std::move(*found));
    return result;
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

void AutosaveThread::request(const Project& project, const fs::path& folder, const std::string& base_hash,
                             const std::vector<fs::path>& contains) {
    std::string text = autosave_text(project, base_hash, contains);
    {
        const std::lock_guard guard(mutex_);
        waiting_ = Job{folder, std::move(text)};
    }
    changed_.notify_all();
}

void AutosaveThread::discard(const fs::path& folder) {
    settle();
    remove_autosave(folder, files_);
}

void AutosaveThread::settle() {
    std::unique_lock guard(mutex_);
    waiting_.reset();
    changed_.wait(guard, [this] { return !writing_; });
}

bool AutosaveThread::has_failed() const {
    const std::lock_guard guard(mutex_);
    return failed_;
}

void AutosaveThread::flush() {
    std::unique_lock guard(mutex_);
    changed_.wait(guard, [this] { return !writing_ && !waiting_; });
}

std::string AutosaveThread::take_error() {
    const std::lock_guard guard(mutex_);
    reported_ = error_.empty() ? reported_ : error_;
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
        } catch (...) {
            error = job.folder.string() + ": cannot be autosaved";
        }
        guard.lock();
        failed_ = !error.empty();
        if (!failed_) reported_.clear();
        error_ = error == reported_ ? "" : error;
        writing_ = false;
        changed_.notify_all();
    }
}

}  // namespace ir::projects
