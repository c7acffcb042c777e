#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ir::gl {

/// State of a file on disk; empty when it does not exist.
struct FileStamp {
    std::filesystem::file_time_type time;  ///< nanoseconds on Linux
    std::uintmax_t bytes = 0;
    bool operator==(const FileStamp&) const = default;
};
using FileStamps = std::map<std::filesystem::path, std::optional<FileStamp>>;
std::optional<FileStamp> stamp_of(const std::filesystem::path& file);

/// One shader stage as the compiler gets it.
struct StageSource {
    std::string text;
    /// Names by the string number in #line and in compiler messages: 0 is the entry file, 1 the preamble.
    std::vector<std::string> files;
};

/// Makes one source of an entry file, all it includes and what the library puts before it: #version, the
/// files' #extension lines (they must precede all code), the defines, the preamble. An included file is
/// inserted once per stage, where it is first named, #if around it or not; it is looked for beside the
/// including file, then in `folder`. Throws Error with "file:line: …" for missing and circular includes and
/// for a #version line. Every file that was read or looked for is entered in `seen`.
StageSource preprocess(const std::filesystem::path& folder, const std::string& entry,
                       const std::map<std::string, std::string>& defines, const std::string& preamble,
                       FileStamps& seen);

}  // namespace ir::gl
