#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ir::projects {

/// The few operations that saving needs, each a step at which a machine can stop. Tests replace it to stop
/// at every step, or to fill the disk. All throw Error with one line on failure.
class FileSystem {
  public:
    virtual ~FileSystem() = default;
    virtual bool exists(const std::filesystem::path& path) = 0;
    /// At most `limit` bytes; a longer file is an InputError.
    virtual std::string read(const std::filesystem::path& file, std::size_t limit) = 0;
    /// Creates or truncates, then writes everything.
    virtual void write(const std::filesystem::path& file, std::string_view bytes) = 0;
    virtual void sync(const std::filesystem::path& file) = 0;  ///< fsync of the file's content
    virtual void sync_directory(const std::filesystem::path& folder) = 0;
    virtual void rename(const std::filesystem::path& from, const std::filesystem::path& to) = 0;
    virtual void remove(const std::filesystem::path& file) = 0;  ///< absence is fine
    virtual void create_directories(const std::filesystem::path& folder) = 0;
    /// Creates or truncates `to`, then writes the bytes of the file `from`, however many.
    virtual void copy(const std::filesystem::path& from, const std::filesystem::path& to) = 0;
    /// The files below a folder, relative to it, in order; none where there is no such folder. Links to
    /// folders are not followed.
    virtual std::vector<std::filesystem::path> list(const std::filesystem::path& folder) = 0;
    /// Removes a folder and all in it, as far as that is possible.
    virtual void remove_all(const std::filesystem::path& folder) = 0;
    /// Nanoseconds since an arbitrary epoch.
    virtual std::int64_t modified(const std::filesystem::path& file) = 0;
};

/// The machine's own.
FileSystem& real_file_system();

/// Writes a temporary file beside `file`, syncs it, renames it over `file` and syncs the folder: afterwards,
/// whatever happens, `file` holds the old or the new bytes. Removes the temporary file on failure.
void write_atomically(FileSystem& files, const std::filesystem::path& file, std::string_view bytes);
/// The same with the bytes of another file; creates the folder where it is missing.
void copy_atomically(FileSystem& files, const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace ir::projects
