#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "projects/document_json.h"
#include "projects/store.h"
#include "renderers/core/file_system.h"

namespace ir::projects {

/// Writes the document beside the saved one. `base_hash` is the hash of the project.json that the changes
/// started from (empty: never saved).
void write_autosave(const Project& project, const std::filesystem::path& folder, const std::string& base_hash,
                    FileSystem& files = real_file_system());
void remove_autosave(const std::filesystem::path& folder, FileSystem& files = real_file_system());

struct Recovery {
    Project project;
    std::string summary;         ///< one line for the question to the user
    std::filesystem::path file;  ///< that holds it
};

/// What a crashed session left: present when an autosave exists that is newer than the saved project and
/// differs from it. A damaged autosave is no recovery and no error.
std::optional<Recovery> find_recovery(const std::filesystem::path& folder, const Registry& registry,
                                      FileSystem& files = real_file_system());

/// Renames the autosave to project.json.recovery-N, out of the way of the next autosave and the next save.
/// Returns the new name. Throws Error.
std::filesystem::path put_autosave_aside(const std::filesystem::path& folder,
                                         FileSystem& files = real_file_system());

/// All that crashed sessions left and nobody decided about yet, newest first. The present autosave is put
/// aside on the way, where it stays until it is taken or discarded (where that fails, it stays in place). For
/// the holder of the lock.
std::vector<Recovery> collect_recoveries(const std::filesystem::path& folder, const Registry& registry,
                                         FileSystem& files = real_file_system());

/// Writes autosaves on a thread of its own, so that a slow disk never stops the window. Newer requests
/// replace waiting ones.
class AutosaveThread {
  public:
    explicit AutosaveThread(FileSystem& files = real_file_system());
    ~AutosaveThread();  ///< writes nothing more
    /// `contains`: recoveries that the document took over; they go once a newer one replaces them.
    void request(const Project& project, const std::filesystem::path& folder, const std::string& base_hash,
                 const std::vector<std::filesystem::path>& contains = {});
    /// Drops what waits, waits for what is being written, and removes the autosave: after a save.
    void discard(const std::filesystem::path& folder);
    /// Drops what waits and waits for what is being written: before a save, so that nothing older than what
    /// is saved is written after it.
    void settle();
    /// Waits until everything requested is written.
    void flush();
    /// The last failure: one line, or empty. The same failure is handed out once until a write succeeds.
    std::string take_error();
    /// Whether the newest request could not be written: ask again later.
    bool has_failed() const;

  private:
    struct Job {
        std::filesystem::path folder;
        std::string text;
    };
    void run();
    FileSystem& files_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Job> waiting_;
    bool writing_ = false, stopping_ = false, failed_ = false;
    std::string error_, reported_;
    std::thread thread_;
};

}  // namespace ir::projects
