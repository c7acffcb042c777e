#include "projects/file_system.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "renderers/core/error.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

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

std::string mend_for(int error) {
    if (error == ENOSPC || error == EDQUOT || error == EFBIG) return "; free some space and try again";
    if (error == EACCES || error == EPERM || error == EROFS) return "; choose a place that you may write to";
    return "";
}

[[noreturn]] void fail(const fs::path& path, const char* action) {
    const int error = errno;
    throw Error(path.string() + ": cannot " + action + ": " + std::strerror(error) + mend_for(error));
}

class RealFileSystem final : public FileSystem {
  public:
    bool exists(const fs::path& path) override {
        std::error_code ignored;
        return fs::exists(path, ignored);
    }

    std::string read(const fs::path& file, std::size_t limit) override {
        const Descriptor descriptor(file, O_RDONLY);
        struct stat info {};
        if (!descriptor.is_open() || ::fstat(descriptor.get(), &info) != 0)
            throw InputError(file.string(), "", std::string("cannot be opened: ") + std::strerror(errno));
        if (!S_ISREG(info.st_mode)) throw InputError(file.string(), "", "is no regular file; give another");
        std::string bytes;
        char block[65536];
        while (true) {
            const auto count = ::read(descriptor.get(), block, sizeof block);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail(file, "read");
            if (count == 0) return bytes;
            bytes.append(block, static_cast<std::size_t>(count));
            if (bytes.size() > limit)
                throw InputError(file.string(), "",
                                 "has more than the " + std::to_string(limit) +
                                     " bytes that are read; it is no such file");
        }
    }

    void write(const fs::path& file, std::string_view bytes) override {
        const Descriptor descriptor(file, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW);
        if (!descriptor.is_open()) fail(file, "create");
        write_all(file, descriptor, bytes);
    }

    void copy(const fs::path& from, const fs::path& to) override {
        const Descriptor source(from, O_RDONLY);
        if (!source.is_open()) fail(from, "open");
        const Descriptor target(to, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW);
        if (!target.is_open()) fail(to, "create");
        std::vector<char> block(1u << 20);
        while (true) {
            const auto count = ::read(source.get(), block.data(), block.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail(from, "read");
            if (count == 0) return;
            write_all(to, target, {block.data(), static_cast<std::size_t>(count)});
        }
    }

    void sync(const fs::path& file) override {
        const Descriptor descriptor(file, O_RDWR);
        if (!descriptor.is_open() || ::fsync(descriptor.get()) != 0) fail(file, "sync");
    }

    void sync_directory(const fs::path& folder) override {
        const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
        if (!descriptor.is_open()) fail(folder, "open");
        // Some network file systems cannot sync folders: there is nothing more to be done on them.
        if (::fsync(descriptor.get()) != 0 && errno != EINVAL && errno != ENOTSUP) fail(folder, "sync");
    }

    void rename(const fs::path& from, const fs::path& to) override {
        if (::rename(from.c_str(), to.c_str()) != 0) fail(to, "replace");
    }

    void remove(const fs::path& file) override {
        if (::unlink(file.c_str()) != 0 && errno != ENOENT) fail(file, "remove");
    }

    void create_directories(const fs::path& folder) override {
        std::error_code error;
        fs::create_directories(folder, error);
        if (!error) return;
        errno = error.value();
        fail(folder, "create");
    }

    std::vector<fs::path> list(const fs::path& folder) override {
        std::vector<fs::path> found;
        std::error_code error;
        fs::recursive_directory_iterator entry(folder, error), end;
        for (; !error && entry != end; entry.increment(error))
            if (entry->is_regular_file(error)) found.push_back(entry->path().lexically_relative(folder));
        std::sort(found.begin(), found.end());
        return found;
    }

    void remove_all(const fs::path& folder) override {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }

    std::int64_t modified(const fs::path& file) override {
        struct stat info {};
        if (::stat(file.c_str(), &info) != 0) fail(file, "inspect");
        return std::int64_t{info.st_mtim.tv_sec} * 1'000'000'000 + info.st_mtim.tv_nsec;
    }

  private:
    static void write_all(const fs::path& file, const Descriptor& descriptor, std::string_view bytes) {
        while (!bytes.empty()) {
            const auto count = ::write(descriptor.get(), bytes.data(), bytes.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail(file, "write");
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
    }
};

template <class Fill>
void replace_atomically(FileSystem& files, const fs::path& file, Fill fill) {
    const fs::path temporary = file.string() + ".tmp";
    try {
        fill(temporary);
        files.sync(temporary);
        files.rename(temporary, file);
    } catch (const Error&) {
        try {
            files.remove(temporary);
        } catch (const Error&) {
            // The first failure is the one to report.
        }
        throw;
    }
    files.sync_directory(file.parent_path());
}

}  // namespace

FileSystem& real_file_system() {
    static RealFileSystem files;
    return files;
}

void write_atomically(FileSystem& files, const fs::path& file, std::string_view bytes) {
    replace_atomically(files, file, [&](const fs::path& temporary) { files.write(temporary, bytes); });
}

void copy_atomically(FileSystem& files, const fs::path& from, const fs::path& to) {
    files.create_directories(to.parent_path());
    replace_atomically(files, to, [&](const fs::path& temporary) { files.copy(from, temporary); });
}

}  // namespace ir::projects
