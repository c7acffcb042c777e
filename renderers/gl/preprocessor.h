#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/changed_shaders.h"

namespace ir::gl {

/// State of a file on disk; empty when it does not exist.
struct FileStamp {
    std::filesystem::file_time_type time;  ///< nanoseconds on Linux
    std::uintmax_t bytes = 0;
    bool operator==(const FileStamp&) const = default;
};
using FileStamps = std::map<std::filesystem::path, std::optional<FileStamp>>;
std::optional<FileStamp> stamp_of(const std::filesystem::path& file);

/// One shader stage as the compiler gets it. Places are kept here and not in #line directives, because Mesa
/// forgets their string numbers in most of its messages.
struct StageSource {
    struct Place {
        std::size_t file = 0;
        int line = 0;
    };
    std::string text;
    std::vector<Place> places;       ///< of each line of the text
    std::vector<std::string> files;  ///< relative to the shader folder; 0 is the entry, 1 generated code

    struct Line {
        std::string place, text;  ///< as place_of() has it; without blanks around it
        int number = 0;           ///< in its file
    };
    /// Counted from 1; empty beyond the text.
    Line line(std::size_t number) const;
    /// "lib/random.glsl:12" for a line of the text, counted from 1; empty beyond the text.
    std::string place_of(std::size_t line) const;
    /// Adds a line of a file.
    void add(const std::string& line, Place place);
};

/// Makes one source of an entry file, all it includes and what the library puts before it: #version, the
/// files' #extension lines (they must precede all code), the defines, the preamble. An included file is
/// inserted once per stage, where it is first named, #if around it or not; it is looked for beside the
/// including file, then in `folder`. Throws Error with "file:line: …" for missing and circular includes and
/// for a #version line, and where a change does not fit. Every file that was read or looked for is entered
/// in `seen`.
StageSource preprocess(const std::filesystem::path& folder, const std::string& entry,
                       const std::map<std::string, std::string>& defines, const std::string& preamble,
                       const ShaderChanges& changes, FileStamps& seen);

}  // namespace ir::gl
