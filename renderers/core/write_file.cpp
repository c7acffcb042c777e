#include "renderers/core/write_file.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <sstream>

#include "renderers/core/error.h"
#include "renderers/core/output_buffer.h"

namespace ir {
namespace {

namespace fs = std::filesystem;

constexpr int max_links = 40;  ///< as in Linux

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : ".";
}

/// What stands there leads to open files, whatever the links say.
bool is_in_proc(const fs::path& file) {
    struct statfs info {};
    return ::statfs(folder_of(file).c_str(), &info) == 0 && info.f_type == PROC_SUPER_MAGIC;
}

struct Place {
    fs::path path;
    bool is_file = true;  ///< otherwise it takes bytes itself
};

/// Behind all links.
Place find_place(fs::path path) {
    for (int links = 0; links <= max_links; ++links) {
        if (is_in_proc(path)) return {path, false};
        std::error_code ignored;
        switch (fs::symlink_status(path, ignored).type()) {
            case fs::file_type::symlink:
                path = folder_of(path) / fs::read_symlink(path, ignored);
                continue;
            case fs::file_type::directory:
                fail(path, "be written", EISDIR);
            case fs::file_type::block:
                throw Error(path.string() + ": is a disk and no file; choose another place");
            case fs::file_type::character:
            case fs::file_type::fifo:
            case fs::file_type::socket:
                return {path, false};
            default:
                return {path, true};
        }
    }
    fail(path, "be written", ELOOP);
}

/// A descriptor of this process keeps its place: what was printed before is not overwritten.
int open_stream(const fs::path& path) {
    std::error_code ignored;
    const auto name = path.filename().string();
    int number = -1;
    if (is_in_proc(path) && fs::equivalent(folder_of(path), "/proc/self/fd", ignored))
        std::from_chars(name.data(), name.data() + name.size(), number);
    return number >= 0 ? ::fcntl(number, F_DUPFD_CLOEXEC, 0)
                       : ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
}

void write_stream(const fs::path& path, const Fill& fill) {
    std::ostringstream collected;  // may seek, unlike pipes
    fill(collected);
    const int descriptor = open_stream(path);
    if (descriptor < 0) fail(path, "be written", errno);
    int error = write_all(descriptor, collected.view());
    if (::close(descriptor) != 0 && error == 0) error = errno;
    if (error != 0) fail(path, "be written", error);
}

}  // namespace

void write_file(const fs::path& file, const Fill& fill) {
    const auto place = find_place(file);
    place.is_file ? write_atomically(real_file_system(), place.path, fill) : write_stream(place.path, fill);
}

void write_file(const fs::path& file, std::string_view bytes) {
    write_file(file, fill_with(bytes));
}

fs::path behind_links(const fs::path& file) {
    return find_place(file).path;
}

}  // namespace ir
