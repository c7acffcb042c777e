#include "projects/open_project.h"

#include <algorithm>
#include <utility>

#include "projects/check.h"
#include "projects/hash.h"
#include "projects/keep.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

/// What belongs to the project beside its document. Kept results join those that are there.
void copy_companions(const fs::path& from, const fs::path& to, FileSystem& files) {
    std::optional<ResultsGuard> guard;
    if (files.exists(from / "results")) guard.emplace(to);
    auto results = ResultIndex::load(to, files);
    bool is_merged = true;
    try {
        results.merge(ResultIndex::load(from, files));
    } catch (const InputError&) {
        is_merged = !results.entries().empty();  // a damaged index comes along where it replaces none
    }
    for (const char* folder : {"results", "thumbnails"}) {
        for (const auto& file : files.list(from / folder)) {
            const bool is_index = folder == std::string_view("results") && file == "index.json";
            if (!(is_index && is_merged) && file.extension() != temporary_extension &&
                file != results_guard_name)
                copy_atomically(files, from / folder / file, to / folder / file);
        }
    }
    if (is_merged && !results.entries().empty()) results.save(to, files);
    if (files.exists(from / "session.json"))
        copy_atomically(files, from / "session.json", to / "session.json");
}

}  // namespace

OpenProject::OpenProject(const Registry& registry, FileSystem& files)
    : EditedDocument(registry), files_(files), autosave_(files) {
    project_.name = "Untitled";
}

OpenProject::OpenProject(Project start, const Registry& registry, FileSystem& files)
    : OpenProject(registry, files) {
    project_ = std::move(start);
    begins_unsaved_ = true;
    look_at_files();
}

OpenProject::OpenProject(const fs::path& given, const Registry& registry, FileSystem& files)
    : EditedDocument(registry),
      files_(files),
      folder_(project_folder(given)),
      lock_(Lock::acquire(folder_)),
      autosave_(files) {
    load();
}

std::unique_ptr<OpenProject> OpenProject::recover_unsaved(const fs::path& folder, const Registry& registry,
                                                          FileSystem& files) {
    auto open = std::make_unique<OpenProject>(registry, files);
    open->unsaved_home_ = UnsavedHome::take_over(folder, files);
    auto found = find_recovery(folder, registry, files);
    if (!found) throw InputError(folder.string(), "", "its autosave is damaged and cannot be read");
    open->project_ = std::move(found->project);
    open->unsaved_place_ = folder.parent_path();
    open->begins_unsaved_ = open->has_autosave_ = true;
    open->look_at_files();
    open->check_again();
    return open;
}

OpenProject::~OpenProject() = default;

void OpenProject::close() {
    if (folder_.empty()) drop_unsaved_home();
    if (!read_only_ && lock_.is_still_ours(files_)) {
        if (has_autosave_) drop_autosave();
        forget_taken();
    }
    lock_.release();
    read_only_ = true;
}

void OpenProject::load() {
    read_only_ = !lock_.is_held();
    auto loaded = load_project(folder_, registry(), files_);
    schema_in_file_ = loaded.schema_in_file;
    reading_messages_ = std::move(loaded.messages);
    file_hash_ = loaded.file_hash;
    begin(std::move(loaded.project), std::move(loaded.last_kept));
    begins_unsaved_ = false;
    has_autosave_ = lost_lock_ = false;
    recovery_.reset();
    older_recoveries_.clear();
    taken_.clear();
    // While another process edits, the autosave is that one's.
    if (!read_only_) remove_left_overs(folder_);
    if (!read_only_) older_recoveries_ = collect_recoveries(folder_, registry(), files_);
    std::reverse(older_recoveries_.begin(), older_recoveries_.end());
    next_recovery();
    contents_.clear();
    look_at_files();
    check_again();
}

void OpenProject::check_again() {
    messages_ = check({project_, schema_in_file_, reading_messages_}, folder_, registry(), &contents_);
}

void OpenProject::look_at_files() {
    requested_sources_ = sources_of(project_);
    hasher_.request(requested_sources_, folder_);
}

/// An edit named a file that nobody looked at yet.
void OpenProject::look_at_new_files() {
    const auto sources = sources_of(project_);
    if (!std::includes(requested_sources_.begin(), requested_sources_.end(), sources.begin(), sources.end()))
        look_at_files();
}

bool OpenProject::poll_files() {
    const bool moves = hasher_.take(animation_ends_), is_other = hasher_.take(contents_);
    if (is_other) check_again();
    return moves || is_other;
}

double OpenProject::animation_end(const std::string& source) const {
    const auto found = animation_ends_.find(resolve(source, folder_).string());
    return found == animation_ends_.end() ? 0 : found->second;
}

void OpenProject::wait_for_files() {
    hasher_.wait();
    poll_files();
}

std::vector<std::string> OpenProject::stale_experiments() const {
    return projects::stale_experiments(project_, registry(), contents_);
}

void OpenProject::has_changed() {
    look_at_new_files();
}

void OpenProject::require_writable() const {
    if (read_only_) throw UsageError(lock_.reason().empty() ? "the project is closed" : lock_.reason());
}

void OpenProject::write(const std::string& expected_hash) {
    autosave_.settle();
    // It would be older than what is saved now, and no longer be offered.
    if (recovery_ && recovery_->file == folder_ / autosave_file_name)
        recovery_->file = put_autosave_aside(folder_, files_);
    autosaved_revision_ = revision() - 1;  // what was dropped is asked for again if saving fails
    const auto saved_revision = revision();
    try {
        file_hash_ = save_project(project_, folder_, expected_hash, files_);
    } catch (const Error&) {
        // The last step may have failed after the new version was in place: then that is what we know.
        const auto file = folder_ / project_file_name;
        const auto written = hash_bytes(write_project(project_));
        if (files_.exists(file) && hash_bytes(files_.read(file, JsonLimits{}.bytes)) == written)
            file_hash_ = written;
        throw;
    }
    schema_in_file_ = schema_version;
    reading_messages_.clear();
    begins_unsaved_ = revision() != saved_revision;  // by events, while the disk was waited for
    if (begins_unsaved_) {
        autosaved_revision_ = saved_revision;  // an autosave of meanwhile is of another base
        return;
    }
    undo_.set_clean();
    drop_autosave();
    forget_taken();
}

void OpenProject::drop_autosave() {
    has_autosave_ = false;
    try {
        autosave_.discard(folder_);
    } catch (const Error&) {
        // It is older than what was saved just now and will not be offered.
    }
}

bool OpenProject::holds_lock() {
    if (lock_.is_still_ours(files_)) return true;
    // Somebody cleaned up; whether the document changed meanwhile is seen by its hash.
    if (!lock_.is_gone(files_)) return false;
    lock_.release();
    lock_ = Lock::acquire(folder_);
    return lock_.is_held();
}

void OpenProject::save(bool overwrite) {
    require_writable();
    if (folder_.empty()) throw UsageError("the project has no folder yet; use save as");
    if (!holds_lock())
        throw Error(folder_.string() + ": somebody else took the lock; save under another name");
    record_hashes(contents_);
    write(overwrite ? "" : file_hash_);
}

/// Whether a relative path was rewritten: steps that hold it would name another file. Absolute ones in steps
/// stay right.
bool OpenProject::move_sources(const fs::path& to) {
    bool moved = false;
    const auto move = [&](std::string& source) {
        if (source.empty() || is_builtin(source)) return;
        // A project that was never saved holds paths as they were given; a saved one keeps absolute ones.
        if (!folder_.empty() && fs::path(source).is_absolute()) return;
        const auto base = folder_.empty() ? fs::current_path() : folder_;
        const auto rewritten = relative_source(resolve(source, base), to);
        moved = moved || (rewritten != source && !fs::path(source).is_absolute());
        source = rewritten;
    };
    for (auto& scene : project_.scenes)
        for (auto& part : scene.parts) move(part.source);
    for (auto& set : project_.lights) move(set.environment.source);
    for (auto& image : project_.images) move(image.source);
    return moved;
}

void OpenProject::save_as(const fs::path& given) {
    const auto target = fs::absolute(folder_with_suffix(given)).lexically_normal();
    std::error_code ignored;
    if (!folder_.empty() && fs::equivalent(target, folder_, ignored)) return save(true);
    const bool is_new = !files_.exists(target);
    files_.create_directories(target);
    auto lock = Lock::acquire(target);
    if (!lock.is_held()) {
        if (is_new) files_.remove_all(target);
        throw Error(target.string() + ": cannot be saved there: " + lock.reason());
    }

    const Project before = project_;
    const auto folder_before = folder_;
    const auto hash_before = file_hash_;
    const bool was_ours = !folder_.empty() && !read_only_ && lock_.is_still_ours(files_);
    record_hashes(contents_);
    const bool moved = move_sources(target);
    if (folder_.empty() && (project_.name.empty() || project_.name == "Untitled"))
        project_.name = target.stem().string();
    try {
        autosave_.settle();
        autosaved_revision_ = revision() - 1;  // what was dropped is asked for again if saving fails
        if (!folder_.empty()) copy_companions(folder_, target, files_);
        folder_ = target;
        write("");
    } catch (const std::exception&) {
        project_ = before;
        folder_ = folder_before;
        file_hash_ = hash_before;
        lock.release();
        if (is_new) files_.remove_all(target);
        throw;
    }
    if (was_ours) leave(folder_before);
    drop_unsaved_home();
    lock_ = std::move(lock);
    read_only_ = false;
    recovery_.reset();
    older_recoveries_.clear();
    taken_.clear();  // what was undone stays where it is and is offered there
    if (moved) forget_steps();
    contents_.clear();
    look_at_files();
    check_again();
}

void OpenProject::rename_folder(const fs::path& to) {
    require_writable();
    if (folder_.empty() || !lock_.is_still_ours(files_))
        throw Error(folder_.string() + ": cannot be renamed; another process has it open");
    autosave_.flush();
    files_.rename(folder_, to);
    const auto follow = [&](fs::path& file) { file = to / file.filename(); };
    if (recovery_) follow(recovery_->file);
    for (auto& each : older_recoveries_) follow(each.file);
    for (const auto& each : taken_) follow(each->file);
    folder_ = to;
    lock_.follow(to);
    look_at_files();
    check_again();
}

/// The folder's autosave holds what is saved elsewhere now.
void OpenProject::leave(const fs::path& folder) {
    if (recovery_ && recovery_->file == folder / autosave_file_name) return;
    try {
        remove_autosave(folder, files_);
    } catch (const Error&) {
        // It will be offered there: better than losing it.
    }
}

void OpenProject::drop_unsaved_home() {
    try {
        autosave_.settle();
        unsaved_home_.remove(files_);
    } catch (const Error&) {
        // It will be offered again: better than losing it.
    }
}

void OpenProject::autosave_unsaved() {
    if (unsaved_place_.empty() || !is_dirty()) return;
    const bool has_home = unsaved_home_.is_ours(files_);
    if (has_home && has_autosave_ && autosaved_revision_ == revision() && !autosave_.has_failed()) return;
    try {
        if (!has_home) unsaved_home_ = UnsavedHome::make(unsaved_place_, project_.name, files_);
    } catch (const Error& error) {
        if (unsaved_error_ != error.what()) autosave_error_ = unsaved_error_ = error.what();
        return;
    }
    autosave_.request(with_absolute_sources(project_, {}), unsaved_home_.folder(), "");
    autosaved_revision_ = revision();
    has_autosave_ = true;
}

void OpenProject::autosave() {
    if (read_only_) return;
    if (folder_.empty()) return autosave_unsaved();
    if (recovery_ && recovery_->file == folder_ / autosave_file_name) return;  // it could not be put aside
    if (!is_dirty() && !has_autosave_) return;
    if (!holds_lock()) {  // the autosave is somebody else's now
        if (!std::exchange(lost_lock_, true))
            autosave_error_ =
                folder_.string() +
                ": somebody else took the lock, so nothing is autosaved; save under another name";
        return;
    }
    if (!is_dirty()) return drop_autosave();
    if (has_autosave_ && autosaved_revision_ == revision() && !autosave_.has_failed()) return;
    autosave_.request(project_, folder_, file_hash_, contained_recoveries());
    autosaved_revision_ = revision();
    has_autosave_ = true;
}

std::string OpenProject::take_autosave_error() {
    auto error = std::exchange(autosave_error_, {});
    return error.empty() ? autosave_.take_error() : error;
}

void OpenProject::break_lock() {
    lock_ = Lock::break_and_acquire(folder_);
    load();
}

}  // namespace ir::projects
