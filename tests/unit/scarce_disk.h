#pragma once

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>

#include "renderers/core/error.h"

/// Disks that are full sooner or later: small ones that only the test sees, and limits on the size of files
/// where a test may not mount.
namespace ir {

/// Runs in a child process, whose own limits, mounts and rights are nobody else's. Returns what `run` says,
/// or what it threw.
inline std::string in_child(const std::function<std::string()>& run) {
    int ends[2];
    if (::pipe(ends) != 0) return "no pipe";
    const pid_t child = ::fork();
    if (child == 0) {
        std::string answer;
        try {
            answer = run();
        } catch (const std::exception& error) {
            answer = std::string("unexpected: ") + error.what();
        }
        const auto written = ::write(ends[1], answer.data(), answer.size());
        ::_exit(written == static_cast<ssize_t>(answer.size()) ? 0 : 1);
    }
    ::close(ends[1]);
    std::string answer;
    char block[4096];
    for (ssize_t count; (count = ::read(ends[0], block, sizeof block)) > 0;)
        answer.append(block, static_cast<std::size_t>(count));
    ::close(ends[0]);
    ::waitpid(child, nullptr, 0);
    return answer;
}

/// A mount that only the calling process and its children see; false where that is not allowed.
inline bool mount_private(const char* type, const std::filesystem::path& place, unsigned long flags,
                          const char* options) {
    const auto user = std::to_string(::getuid()), group = std::to_string(::getgid());
    if (::unshare(CLONE_NEWNS) != 0) {
        if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
        std::ofstream("/proc/self/setgroups") << "deny";
        std::ofstream("/proc/self/uid_map") << user << " " << user << " 1";
        std::ofstream("/proc/self/gid_map") << group << " " << group << " 1";
    }
    if (::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return false;
    return ::mount(type, place.c_str(), type, flags, options) == 0;
}

/// Work that is done again and again in a folder of its own, each time with a little more room.
struct Ordeal {
    std::function<void(const std::filesystem::path& folder)> prepare;  ///< has all the room it wants
    std::function<void(const std::filesystem::path& folder)> work;     ///< throws Error where it fails
    /// Empty, or what is wrong afterwards.
    std::function<std::string(const std::filesystem::path& folder, bool done)> check;
};

inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

inline std::string read_bytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline void remove_contents(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        std::filesystem::remove_all(entry.path());
}

/// The name of a file that is not finished, or nothing.
inline std::string unfinished_in(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".tmp" || entry.path().extension() == ".part")
            return entry.path().string() + " was left";
    return "";
}

/// "ok", or what went wrong with how much room. `scarce(room)` leaves so much, `plentiful` all.
inline std::string with_more_and_more_room(const std::filesystem::path& folder, const Ordeal& ordeal,
                                           const std::function<void(std::size_t room)>& scarce,
                                           const std::function<void()>& plentiful, std::size_t step) {
    constexpr std::size_t max_trials = 10'000;
    for (std::size_t room = 0; room < max_trials * step; room += step) {
        remove_contents(folder);
        ordeal.prepare(folder);
        scarce(room);
        std::string said;
        bool done = true;
        try {
            ordeal.work(folder);
        } catch (const Error& error) {
            done = false;
            said = error.what();
        }
        plentiful();
        auto wrong = unfinished_in(folder);
        if (wrong.empty() && !done && (said.empty() || said.find('\n') != std::string::npos))
            wrong = "it does not fail with one line";
        if (wrong.empty()) wrong = ordeal.check(folder, done);
        if (!wrong.empty()) return "room for " + std::to_string(room) + ": " + wrong + " (" + said + ")";
        if (done) return room > 0 ? "ok" : "it needs no room at all";
    }
    return "there is never enough room";
}

/// On a disk with every number of free pages, from none until the work can be done.
inline std::string with_few_pages(const std::filesystem::path& folder, const Ordeal& ordeal) {
    return in_child([&]() -> std::string {
        if (!mount_private("tmpfs", folder, 0, "size=4m")) return "not allowed";
        const auto filler = folder / "filler";
        const auto fill_up_to = [&](std::size_t pages) {
            struct statvfs disk {};
            ::statvfs(folder.c_str(), &disk);
            const int file = ::open(filler.c_str(), O_WRONLY | O_CREAT, 0600);
            const bool filled =
                ::posix_fallocate(file, 0, static_cast<off_t>((disk.f_bfree - pages) * disk.f_bsize)) == 0;
            ::close(file);
            ::statvfs(folder.c_str(), &disk);
            if (!filled || disk.f_bfree != pages) throw std::runtime_error("the disk cannot be filled");
        };
        return with_more_and_more_room(
            folder, ordeal, fill_up_to, [&] { std::filesystem::remove(filler); }, 1);
    });
}

/// No file may grow larger, for as long as this lives: what is written to it fails as on a full disk.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{std::min(bytes, before_.rlim_max), before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    void (*handler_)(int);
    rlimit before_{};
};

/// With every limit on the size of files, in steps of some bytes. Never skips.
inline std::string with_small_files(const std::filesystem::path& folder, const Ordeal& ordeal,
                                    std::size_t step) {
    return in_child([&] {
        std::optional<FileSizeLimit> limit;
        return with_more_and_more_room(
            folder, ordeal, [&](std::size_t bytes) { limit.emplace(bytes); }, [&] { limit.reset(); }, step);
    });
}

/// Empty where `write` throws Error as there is no room for `file`, and all is as it was; else what is wrong.
inline std::string is_refused_without_room(const std::filesystem::path& file,
                                           const std::function<void()>& write) {
    const std::string before = "what stood there before";
    for (const rlim_t room : {0, 1, 40}) {
        write_bytes(file, before);
        try {
            const FileSizeLimit limit(room);
            write();
            return "no error with room for " + std::to_string(room);
        } catch (const Error&) {
        }
        if (read_bytes(file) != before) return "gone with room for " + std::to_string(room);
        if (auto left = unfinished_in(file.parent_path()); !left.empty()) return left;
    }
    return "";
}

}  // namespace ir
