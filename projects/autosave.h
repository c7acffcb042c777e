#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "projects/document_json.h"
#include "projects/file_system.h"

namespace ir::projects {

inline constexpr const char* autosave_file_name = "project.json.autosave";

/// Writes the document beside the saved one. `base_hash` is the hash of the project.json that the changes
/// started from (empty: never saved).
void write_autosave(const Project& project, const std::filesystem::path& folder, const std::string& base_hash,
                    FileSystem& files = real_file_system());
void remove_autosave(const std::filesystem::path& folder, FileSystem& files = real_file_system());

struct Recovery {
    Project project;
    std::string summary;  ///< one line for the question to the user
};

/// What a crashed session left: present when an autosave exists that is newer than the saved project and
/// differs from it. A damaged autosave is no recovery and no error.
std::optional<Recovery> find_recovery(const std::filesystem::path& folder, const Registry& registry,
                                      FileSystem& files = real_file_system());

/// Writes autosaves on a thread of its own, so that a slow disk never stops the window. Newer requests
/// replace waiting ones.
class AutosaveThread {
  public:
    explicit AutosaveThread(FileSystem& files = real_file_system());
    ~AutosaveThread();  ///< writes nothing more
    void request(const Project& project, const std::filesystem::path& folder, const std::string& base_hash);
    /// Drops what waits, waits for what is being written, and removes the autosave: after a save.
    void discard(const std::filesystem::path& folder);
    /// Waits until everything requested is written.
    void flush();
    /// The last failure, once: one line, or empty.
    std::string take_error();

  private:
    struct Job {
        std::filesystem::path folder;
        std::string text;
    };
    void run();
    FileSystem& files_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Job> waiting_;
    bool writing_ = false, stopping_ = false;
    std::string error_;
    std::thread thread_;
};

}  // namespace ir::projects
