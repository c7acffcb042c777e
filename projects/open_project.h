#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "projects/autosave.h"
#include "projects/edited_document.h"
#include "projects/lock.h"
#include "projects/scene_hasher.h"
#include "projects/store.h"
#include "projects/unsaved.h"

namespace ir::projects {

/// A project open in a window: the document with its place on the disk: lock, saving, autosave. One thread
/// (the GUI's).
class OpenProject : public EditedDocument {
  public:
    /// A new, empty, unsaved project.
    explicit OpenProject(const Registry& registry, FileSystem& files = real_file_system());
    /// A new, unsaved project that begins as `start`; nothing before that can be undone to.
    OpenProject(Project start, const Registry& registry, FileSystem& files = real_file_system());
    /// Opens for editing, or read-only when another process holds the lock or the folder cannot be written.
    OpenProject(const std::filesystem::path& given, const Registry& registry,
                FileSystem& files = real_file_system());
    /// Takes over what a process that ended left of a project that was never saved (see unsaved.h): again
    /// without a folder, and unsaved. Throws Error when another process has it.
    static std::unique_ptr<OpenProject> recover_unsaved(const std::filesystem::path& folder,
                                                        const Registry& registry,
                                                        FileSystem& files = real_file_system());
    /// Gives the lock back. Without close() before, an autosave stays behind and is offered as a recovery.
    ~OpenProject() override;
    /// The user is done with the project, unsaved changes included: removes the autosave, gives back the
    /// lock.
    void close();

    const std::filesystem::path& folder() const { return folder_; }  ///< empty: never saved
    bool is_read_only() const { return read_only_; }
    const std::string& read_only_reason() const { return lock_.reason(); }
    /// From reading and check(): for the banner and the log.
    const std::vector<Message>& messages() const { return messages_; }
    void check_again();

    /// Scenes, maps and images are hashed on a thread of their own: opening never waits for them. Takes over
    /// what it found since the last call; returns whether messages(), states of files or stale_experiments()
    /// may have changed. Called when `on_news` says so, or now and then.
    bool poll_files();
    /// `on_news` is called on the hashing thread and only passes the word on; empty: no more calls.
    void set_on_files_read(std::function<void()> on_news) { hasher_.set_on_news(std::move(on_news)); }
    /// Looks at all files again (the window became active, a file was located); unchanged ones are not read.
    void look_at_files();
    void wait_for_files();  ///< blocks until all are read: for commands and tests
    /// What is known of the files, for status(…, folder(), &contents()) in scene_files.h.
    const ContentHashes& contents() const { return contents_; }
    /// Seconds until which a source that is a file animates its nodes; 0: nothing moves, as far as is known.
    double animation_end(const std::string& source) const;
    /// Experiments whose kept result is no longer what they would render now.
    std::vector<std::string> stale_experiments() const;

    /// Throws Error (one line) and loses nothing on failure. `overwrite` also when the file on disk changed.
    /// Sources without a recorded hash get that of contents(), as far as it is known; no step of undo.
    void save(bool overwrite = false);
    /// Into another folder, whose lock is taken; kept results are copied to those that are there; relative
    /// sources are rewritten to stay valid (then undo begins anew, because older states would point to the
    /// wrong place).
    void save_as(const std::filesystem::path& given);
    /// Renames the folder within its parent, where it is open still. Throws Error, and nothing has changed.
    void rename_folder(const std::filesystem::path& to);
    /// To be called now and then (a timer): writes an autosave when there are unsaved changes, again when the
    /// last one failed.
    void autosave();
    /// While the project was never saved, it is autosaved in a folder of its own inside `place` (see
    /// unsaved.h), which goes with close() and the first save. Empty: not at all.
    void autosave_unsaved_in(const std::filesystem::path& place) { unsaved_place_ = place; }
    void wait_for_autosave() { autosave_.flush(); }
    std::string take_autosave_error();  ///< one line or empty; every failure once

    /// What a crashed session left; ask the user, then take or discard it. It stays on the disk until then,
    /// whatever is edited and saved meanwhile. Afterwards an older one may follow.
    const std::optional<Recovery>& recovery() const { return recovery_; }
    /// A step of undo: unsaved changes come back with it. The recovery goes with the next save or close()
    /// that has it; undone, it stays and is offered again when the project is opened.
    void take_recovery();
    void discard_recovery();

    /// Takes the lock from whoever holds it; only after the user said so. Reloads the document.
    void break_lock();

  private:
    /// Shared with the step of undo that took it.
    struct TakenRecovery {
        std::filesystem::path file;
        bool is_held = false;  ///< the document has that step
    };
    class TakeRecovery;
    void require_writable() const override;
    void has_changed() override;
    void load();
    void look_at_new_files();
    void write(const std::string& expected_hash);
    void drop_autosave();
    void next_recovery();
    void forget_taken();
    std::vector<std::filesystem::path> contained_recoveries() const;
    void leave(const std::filesystem::path& folder);
    bool holds_lock();
    bool move_sources(const std::filesystem::path& to);
    void autosave_unsaved();
    void drop_unsaved_home();
    FileSystem& files_;
    std::filesystem::path folder_;
    Lock lock_;
    std::filesystem::path unsaved_place_;
    UnsavedHome unsaved_home_;
    bool read_only_ = false;
    bool has_autosave_ = false, lost_lock_ = false;
    std::string autosave_error_, unsaved_error_;
    int schema_in_file_ = schema_version;
    std::vector<Message> reading_messages_;
    std::vector<Message> messages_;
    ContentHashes contents_;
    AnimationEnds animation_ends_;
    std::set<std::string> requested_sources_;
    std::optional<Recovery> recovery_;
    std::vector<Recovery> older_recoveries_;             ///< oldest first
    std::vector<std::shared_ptr<TakenRecovery>> taken_;  ///< not saved yet, oldest first
    std::string file_hash_;
    std::size_t autosaved_revision_ = 0;
    AutosaveThread autosave_;
    SceneHasher hasher_;
};

}  // namespace ir::projects
