#include "renderers/core/file_system.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <tuple>
#include <utility>

#include "renderers/core/error.h"
#include "renderers/core/new_files.h"
#include "renderers/core/output_buffer.h"

namespace ir {

namespace {

namespace fs = std::filesystem;

/// In a folder that somebody else made, what is read may be a pipe: none is waited for.
constexpr int reading = O_RDONLY | O_NONBLOCK;

/// Closes on every way out.
class Descriptor {
  public:
    Descriptor(const fs::path& path, int flags) : value_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    bool is_open() const { return value_ >= 0; }
    int get() const { return value_; }

  private:
    int value_;
};

/// An empty file with the permissions of `target`, as far as that is possible. Negative: see errno.
int create_like(const fs::path& target, const fs::path& file) {
    struct stat info {};
    const bool is_new = ::lstat(target.c_str(), &info) != 0 || !S_ISREG(info.st_mode);
    const int descriptor =
        ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, is_new ? 0666 : 0600);
    if (descriptor < 0 || is_new) return descriptor;
    // Not every file system knows them, and only the superuser gives files away.
    std::ignore = ::fchown(descriptor, info.st_uid, info.st_gid);
    std::ignore = ::fchmod(descriptor, info.st_mode & 0777);
    return descriptor;
}

/// FileSystem::write(); if not `is_synced`, some may be on its way to the disk.
void create(const fs::path& temporary, const fs::path& target, const Fill& fill, bool is_synced) {
    const int descriptor = create_like(target, temporary);
    if (descriptor < 0) fail(target, "be written", errno);
    OutputBuffer buffer(descriptor);
    std::ostream out(&buffer);
    try {
        fill(out);
    } catch (const std::exception&) {
        if (buffer.error() == 0) throw;  // otherwise that is the cause
    }
    buffer.close(is_synced);
    if (buffer.error() != 0) fail(target, "be written", buffer.error());
    // Some file systems lose bytes and say nothing.
    std::error_code error;
    const auto length = fs::file_size(temporary, error);
    if (error || length != buffer.length() || out.fail()) fail(target, "be written", EIO);
}

/// What was removed while somebody had it open: network file systems give it such a name until then.
bool is_kept_by_nfs(const fs::path& file) {
    return file.filename().string().starts_with(".nfs");
}

class RealFileSystem final : public FileSystem {
  public:
    bool exists(const fs::path& path) override {
        std::error_code ignored;
        return fs::exists(path, ignored);
    }

    std::string read(const fs::path& file, std::size_t limit) override {
        constexpr int most_tries = 5;
        for (int i = 0; i < most_tries; ++i)
            if (auto bytes = read_once(file, limit)) return std::move(*bytes);
        fail(file, "read", ESTALE);
    }

    void write(const fs::path& temporary, const fs::path& target, const Fill& fill) override {
        create(temporary, target, fill, true);
    }

    void sync_directory(const fs::path& folder) override {
        const Descriptor descriptor(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
        // Some network file systems cannot sync folders, and not everybody may read those he may write: there
        // is nothing more to be done.
        if (!descriptor.is_open() && errno == EACCES) return;
        if (!descriptor.is_open()) fail(folder, "open", errno);
        if (::fsync(descriptor.get()) != 0 && errno != EINVAL && errno != ENOTSUP)
            fail(folder, "sync", errno);
    }

    void rename(const fs::path& from, const fs::path& to) override {
        struct stat before {
        }, after{};
        const bool is_known = ::lstat(from.c_str(), &before) == 0;
        if (::rename(from.c_str(), to.c_str()) == 0) return;
        const int error = errno;
        // A network may lose the answer of what was done; asked again, it says that there is no such file.
        const bool is_done = is_known && ::lstat(to.c_str(), &after) == 0 && after.st_ino == before.st_ino &&
                             after.st_dev == before.st_dev && ::lstat(from.c_str(), &after) != 0;
        if (!is_done) fail(to, "replace", error);
    }

    void remove(const fs::path& file) override {
        if (::unlink(file.c_str()) != 0 && errno != ENOENT) fail(file, "remove", errno);
    }

    void create_directories(const fs::path& folder) override {
        std::error_code error;
        fs::create_directories(folder, error);
        if (error) fail(folder, "create", error.value());
    }

    void pour(const fs::path& file, std::ostream& out) override {
        const Descriptor descriptor(file, reading);
        if (!descriptor.is_open()) fail(file, "open", errno);
        std::vector<char> block(1u << 20);
        while (out) {
            const auto count = ::read(descriptor.get(), block.data(), block.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail(file, "read", errno);
            if (count == 0) return;
            out.write(block.data(), count);
        }
    }

    std::vector<fs::path> list(const fs::path& folder) override {
        std::vector<fs::path> found;
        std::error_code error;
        fs::recursive_directory_iterator entry(folder, error), end;
        for (; !error && entry != end; entry.increment(error))
            if (entry->is_regular_file(error) && !is_kept_by_nfs(entry->path()))
                found.push_back(entry->path().lexically_relative(folder));
        std::sort(found.begin(), found.end());
        return found;
    }

    void remove_all(const fs::path& folder) override {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }

    std::int64_t modified(const fs::path& file) override {
        struct stat info {};
        if (::stat(file.c_str(), &info) != 0) fail(file, "inspect", errno);
        return std::int64_t{info.st_mtim.tv_sec} * 1'000'000'000 + info.st_mtim.tv_nsec;
    }

  private:
    /// Nothing where another machine of a network replaced the file meanwhile.
    static std::optional<std::string> read_once(const fs::path& file, std::size_t limit) {
        const Descriptor descriptor(file, reading);
        struct stat info {};
        if (!descriptor.is_open() || ::fstat(descriptor.get(), &info) != 0) {
            if (errno == ESTALE) return std::nullopt;
            throw InputError(file.string(), "", std::string("cannot be opened: ") + std::strerror(errno));
        }
        if (!S_ISREG(info.st_mode)) throw InputError(file.string(), "", "is no regular file; give another");
        std::string bytes;
        char block[65536];
        while (true) {
            const auto count = ::read(descriptor.get(), block, sizeof block);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0 && errno == ESTALE) return std::nullopt;
            if (count < 0) fail(file, "read", errno);
            if (count == 0) return bytes;
            bytes.append(block, static_cast<std::size_t>(count));
            if (bytes.size() > limit)
                throw InputError(file.string(), "",
                                 "has more than the " + std::to_string(limit) +
                                     " bytes that are read; it is no such file");
        }
    }
};

/// Whether its process has ended.
bool is_left_over(const fs::path& file) {
    const auto number = file.stem().extension().string();  // ".PID-N"
    if (file.extension() != temporary_extension || number.empty()) return false;
    const auto* end = number.data() + number.size();
    pid_t process = 0;
    const auto parsed = std::from_chars(number.data() + 1, end, process);
    const bool is_temporary = parsed.ec == std::errc{} && parsed.ptr != end && *parsed.ptr == '-';
    return is_temporary && process > 0 && ::kill(process, 0) != 0 && errno == ESRCH;
}

}  // namespace

Fill fill_with(std::string_view bytes) {
    return
        [bytes](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); };
}

FileSystem& real_file_system() {
    static RealFileSystem files;
    return files;
}

fs::path temporary_beside(FileSystem& files, const fs::path& file) {
    static std::atomic<unsigned> counter = 0;
    // What an earlier process of this number left is in nobody's way.
    while (true) {
        const auto number = std::to_string(::getpid()) + "-" + std::to_string(++counter);
        fs::path temporary = file.string() + "." + number + temporary_extension;
        if (!files.exists(temporary)) return temporary;
    }
}

void write_atomically(FileSystem& files, const fs::path& file, const Fill& fill) {
    const auto temporary = temporary_beside(files, file);
    try {
        files.write(temporary, file, fill);
        files.rename(temporary, file);
    } catch (const std::exception&) {
        try {
            files.remove(temporary);
        } catch (const Error&) {
            // The first failure is the one to report.
        }
        throw;
    }
    files.sync_directory(file.parent_path());
}

void write_atomically(FileSystem& files, const fs::path& file, std::string_view bytes) {
    write_atomically(files, file, fill_with(bytes));
}

void write_new_file(const fs::path& file, const Fill& fill) {
    create(file, file, fill, false);
}

void sync_disk_of(const fs::path& folder) {
    const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
    if (!descriptor.is_open()) fail(folder, "open", errno);
    if (::syncfs(descriptor.get()) != 0) fail(folder, "be written", errno);
}

void remove_left_overs(const fs::path& folder, bool and_below) {
    std::error_code error, ignored;
    fs::recursive_directory_iterator entry(folder, error), end;
    for (; !error && entry != end; entry.increment(error)) {
        if (!and_below) entry.disable_recursion_pending();
        if (is_left_over(entry->path())) fs::remove(entry->path(), ignored);
    }
}

void copy_atomically(FileSystem& files, const fs::path& from, const fs::path& to) {
    files.create_directories(to.parent_path());
    write_atomically(files, to, [&](std::ostream& out) { files.pour(from, out); });
}

void require_regular_file(const std::filesystem::path& file) {
    std::error_code failure;
    const auto status = std::filesystem::status(file, failure);
    if (std::filesystem::is_regular_file(status)) return;
    if (std::filesystem::exists(status))
        throw InputError(file.string(), "", "is no regular file; give the path of another");
    if (failure && status.type() != std::filesystem::file_type::not_found)
        throw InputError(file.string(), "", "cannot be read: " + failure.message());
    throw InputError(file.string(), "", "there is no such file; check the path");
}

}  // namespace ir
