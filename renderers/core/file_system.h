#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace ir {

/// Puts a file's content into a stream, which may seek. What the stream could not take is an error of the
/// write; nobody who fills needs to look at the stream's state.
using Fill = std::function<void(std::ostream&)>;
Fill fill_with(std::string_view bytes);  ///< which must live as long

/// The few operations that saving needs, each a step at which a machine can stop. Tests replace it to stop
/// at every step, or to fill the disk. All throw Error with one line on failure.
class FileSystem {
  public:
    virtual ~FileSystem() = default;
    virtual bool exists(const std::filesystem::path& path) = 0;
    /// At most `limit` bytes; a longer file is an InputError.
    virtual std::string read(const std::filesystem::path& file, std::size_t limit) = 0;
    /// Creates `temporary`, which must not exist, and puts everything into it. Returns when all bytes are on
    /// the disk and counted there. It gets the permissions of `target`, where there is such a file; errors
    /// name `target`, too.
    virtual void write(const std::filesystem::path& temporary, const std::filesystem::path& target,
                       const Fill& fill) = 0;
    virtual void sync_directory(const std::filesystem::path& folder) = 0;
    virtual void rename(const std::filesystem::path& from, const std::filesystem::path& to) = 0;
    virtual void remove(const std::filesystem::path& file) = 0;  ///< absence is fine
    virtual void create_directories(const std::filesystem::path& folder) = 0;
    /// Puts the bytes of a file, however many, into a stream.
    virtual void pour(const std::filesystem::path& file, std::ostream& out) = 0;
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

/// What files are called while they are written, and stay called when the machine stops meanwhile.
inline constexpr const char* temporary_extension = ".tmp";

/// A name beside `file` that nothing has: unique among processes and threads.
std::filesystem::path temporary_beside(FileSystem& files, const std::filesystem::path& file);

/// Writes a temporary beside `file`, renames it over `file` and syncs the folder: whatever happens, `file`
/// holds the old or the new bytes. Removes the temporary on failure. A link is replaced, not followed, as
/// projects may come from anybody; write_file.h follows.
void write_atomically(FileSystem& files, const std::filesystem::path& file, const Fill& fill);
void write_atomically(FileSystem& files, const std::filesystem::path& file, std::string_view bytes);
/// The same with the bytes of another file; creates the folder where it is missing.
void copy_atomically(FileSystem& files, const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes the temporaries of processes that have ended, also those below the folder if asked; what cannot be
/// removed stays. Processes of other machines that share the folder look ended: only while nobody else may
/// write there.
void remove_left_overs(const std::filesystem::path& folder, bool and_below = false);

/// Before reading: throws InputError where the file is not there, or is a folder, device or pipe, which may
/// never end.
void require_regular_file(const std::filesystem::path& file);

}  // namespace ir
