#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "renderers/core/file_system.h"

namespace ir::projects {

/// Who has a project open.
struct LockHolder {
    std::string host;
    std::int64_t pid = 0;
    std::uint64_t started = 0;  ///< start time of the process in kernel ticks: tells apart reused pids
    std::string since;          ///< date and time, UTC, for people
    bool operator==(const LockHolder&) const = default;
};

/// The right to write a project: file .lock in its folder. One writer at a time; everybody else reads. The
/// lock of a process that no longer lives on this host is taken over; that of another host never is by
/// itself.
class Lock {
  public:
    /// Tries to take the lock; never waits and never throws for a held lock: ask is_held().
    static Lock acquire(const std::filesystem::path& folder);
    /// Takes the lock whoever holds it; only after the user said so.
    static Lock break_and_acquire(const std::filesystem::path& folder);
    /// Whether acquire() would find nobody in its way. Writes nothing.
    static bool is_free(const std::filesystem::path& folder);

    Lock() = default;
    Lock(Lock&& other) noexcept;
    Lock& operator=(Lock&& other) noexcept;
    ~Lock();
    void release();                                    ///< removes the file if it is still ours
    void follow(const std::filesystem::path& folder);  ///< that was renamed

    bool is_held() const { return held_; }
    /// Looks at the file again: somebody may have broken the lock.
    bool is_still_ours(FileSystem& files = real_file_system()) const;
    /// The file is not there: somebody removed it without taking the lock.
    bool is_gone(FileSystem& files = real_file_system()) const;
    /// Why not: one line for the banner, "open for writing by process 12 on host a since …".
    const std::string& reason() const { return reason_; }
    const std::optional<LockHolder>& holder() const { return holder_; }

  private:
    static Lock take(const std::filesystem::path& folder, bool by_force);
    std::filesystem::path file_;
    LockHolder self_;
    bool held_ = false;
    std::string reason_;
    std::optional<LockHolder> holder_;
};

}  // namespace ir::projects
