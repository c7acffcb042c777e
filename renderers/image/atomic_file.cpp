#include "renderers/image/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>

#include "renderers/core/error.h"

namespace ir {
namespace {

/// Unique among processes and threads; keeps the extension for writers that go by it.
std::filesystem::path temporary_beside(const std::filesystem::path& file) {
    static std::atomic<unsigned> counter = 0;
    std::string name = ".";
    name += file.stem().string() + "." + std::to_string(getpid()) + "-" + std::to_string(++counter);
    return file.parent_path() / (name + file.extension().string());
}

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
    throw Error(file.string() + ": cannot be written (" + std::generic_category().message(error) +
                "); choose a folder that exists and is writable");
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path file)
    : file_(std::move(file)), temporary_(temporary_beside(file_)) {
    if (std::filesystem::is_directory(file_)) refuse(file_, EISDIR);
    const int descriptor = open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0) refuse(file_, errno);
    close(descriptor);
}

AtomicFile::~AtomicFile() {
    std::error_code ignored;
    if (!committed_) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
    const int descriptor = open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) refuse(file_, errno);
    const int failed = fsync(descriptor) == 0 ? 0 : errno;
    close(descriptor);
    if (failed) refuse(file_, failed);
    std::error_code error;
    std::filesystem::rename(temporary_, file_, error);
    if (error) refuse(file_, error.value());
    committed_ = true;
}

}  // namespace ir
