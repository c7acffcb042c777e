#include "projects/lock.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "projects/json.h"
#include "projects/object_reader.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

constexpr const char* lock_file_name = ".lock";

/// What /proc says of a process: whether it lives, and since when. [proc(5), fields 3 and 22 of stat]
struct ProcessState {
    bool alive = false;
    std::uint64_t started = 0;
};

ProcessState process_state(std::int64_t pid) {
    ProcessState state;
    if (pid <= 0 || (::kill(static_cast<pid_t>(pid), 0) != 0 && errno != EPERM)) return state;
    state.alive = true;
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string line;
    std::getline(stat, line);
    // The name in parentheses may contain anything; fields are counted behind it.
    const auto name_end = line.rfind(')');
    if (name_end == std::string::npos) return state;
    std::istringstream fields(line.substr(name_end + 1));
    std::string field;
    for (int i = 3; i <= 22 && fields >> field; ++i) {
        if (i == 3 && (field == "Z" || field == "X")) state.alive = false;
        if (i == 22) state.started = std::strtoull(field.c_str(), nullptr, 10);
    }
    return state;
}

std::string host_name() {
    char name[256] = {};
    ::gethostname(name, sizeof name - 1);
    return name;
}

LockHolder this_process() {
    return {host_name(), ::getpid(), process_state(::getpid()).started, utc_now()};
}

bool has_ended(const LockHolder& holder) {
    if (holder.host != host_name()) return false;
    const auto state = process_state(holder.pid);
    if (!state.alive) return true;
    return holder.started != 0 && state.started != 0 && holder.started != state.started;
}

std::string to_text(const LockHolder& holder) {
    return pretty_json(Json::object(
        {{"host", holder.host}, {"pid", holder.pid}, {"started", holder.started}, {"since", holder.since}}));
}

/// Nothing when there is no such file or when it is damaged.
std::optional<LockHolder> read_holder(const fs::path& file, FileSystem& files = real_file_system()) {
    constexpr std::size_t max_bytes = 4096;
    try {
        const Json json = parse_json(files.read(file, max_bytes), file.string());
        ObjectReader reader(json, file.string(), "");
        LockHolder holder;
        holder.host = reader.required_text("host");
        holder.pid = reader.integer("pid", 0, 1, std::int64_t{1} << 40);
        holder.started = reader.natural("started", 0);
        holder.since = reader.text("since");
        return holder;
    } catch (const Error&) {
        return std::nullopt;
    }
}

std::string held_by(const std::optional<LockHolder>& holder, const fs::path& file) {
    if (!holder)
        return "open read-only: the lock " + file.string() + " is damaged; delete it if nobody has it open";
    return "open read-only: being edited by process " + std::to_string(holder->pid) + " on host " +
           printable(holder->host, 80) +
           (holder->since.empty() ? "" : " since " + printable(holder->since, 40));
}

/// Serialises the takers of this host while they look and decide; ends with the descriptor.
class FolderGuard {
  public:
    explicit FolderGuard(const fs::path& folder)
        : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        // Where folders cannot be locked (some network file systems) creation alone still decides.
        if (descriptor_ >= 0) ::flock(descriptor_, LOCK_EX);
    }
    ~FolderGuard() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    FolderGuard(const FolderGuard&) = delete;
    FolderGuard& operator=(const FolderGuard&) = delete;

  private:
    int descriptor_;
};

/// A network may lose the answer of what was done; asked again, it says that the name is taken. [open(2)]
bool has_two_names(const fs::path& file) {
    struct stat info {};
    return ::stat(file.c_str(), &info) == 0 && info.st_nlink == 2;
}

/// Creates the lock whole or not at all: written aside, then linked to its name, which must be free. Returns
/// 0 or errno.
int create_lock(const fs::path& file, const std::string& text) {
    const fs::path aside = file.string() + "." + host_name() + "-" + std::to_string(::getpid());
    ::unlink(aside.c_str());  // of an earlier process of this number
    const int descriptor = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (descriptor < 0) return errno;
    const bool written = ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    int error = written ? 0 : (errno != 0 ? errno : EIO);
    ::close(descriptor);
    if (error == 0 && ::link(aside.c_str(), file.c_str()) != 0) {
        error = errno;
        if (has_two_names(aside)) error = 0;
    }
    ::unlink(aside.c_str());
    if (error != EPERM && error != ENOTSUP) return error;
    // No hard links here: exclusive creation is the next best.
    const int exclusive = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (exclusive < 0) return errno;
    const bool all = ::write(exclusive, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    ::close(exclusive);
    return all ? 0 : EIO;
}

}  // namespace

Lock Lock::take(const fs::path& folder, bool by_force) {
    Lock lock;
    lock.file_ = folder / lock_file_name;
    lock.self_ = this_process();
    const FolderGuard guard(folder);
    int error = create_lock(lock.file_, to_text(lock.self_));
    if (error == EEXIST) {
        lock.holder_ = read_holder(lock.file_);
        const bool may_take = by_force || (lock.holder_ && has_ended(*lock.holder_));
        // Gone already: by others, or by us where a network lost the answer. Creation decides who has it.
        if (may_take && (::unlink(lock.file_.c_str()) == 0 || errno == ENOENT))
            error = create_lock(lock.file_, to_text(lock.self_));
    }
    lock.held_ = error == 0;
    if (error == EEXIST)
        lock.reason_ = held_by(lock.holder_, lock.file_);
    else if (error != 0)
        lock.reason_ = "open read-only: " + folder.string() + " cannot be written: " + std::strerror(error);
    if (lock.held_) lock.holder_.reset();
    return lock;
}

Lock Lock::acquire(const fs::path& folder) {
    return take(folder, false);
}

Lock Lock::break_and_acquire(const fs::path& folder) {
    return take(folder, true);
}

bool Lock::is_free(const fs::path& folder) {
    const auto file = folder / lock_file_name;
    std::error_code error;
    if (!fs::exists(fs::symlink_status(file, error))) return true;
    const auto holder = read_holder(file);
    return holder && has_ended(*holder);
}

Lock::Lock(Lock&& other) noexcept {
    *this = std::move(other);
}

Lock& Lock::operator=(Lock&& other) noexcept {
    if (this == &other) return *this;
    release();
    file_ = std::move(other.file_);
    self_ = std::move(other.self_);
    held_ = std::exchange(other.held_, false);
    reason_ = std::move(other.reason_);
    holder_ = std::move(other.holder_);
    return *this;
}

Lock::~Lock() {
    release();
}

void Lock::release() {
    if (!std::exchange(held_, false)) return;
    // A child of fork() holds a copy; only the taker gives it back.
    if (self_.pid != ::getpid()) return;
    const FolderGuard guard(file_.parent_path());
    if (read_holder(file_) == self_) ::unlink(file_.c_str());
}

void Lock::follow(const fs::path& folder) {
    file_ = folder / lock_file_name;
}

bool Lock::is_still_ours(FileSystem& files) const {
    return held_ && read_holder(file_, files) == self_;
}

bool Lock::is_gone(FileSystem& files) const {
    return held_ && !files.exists(file_);
}

}  // namespace ir::projects
