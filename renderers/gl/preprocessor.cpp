#include "renderers/gl/preprocessor.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "renderers/core/error.h"

namespace ir::gl {
namespace {

namespace fs = std::filesystem;

std::string line_directive(int line, std::size_t file) {
    return "#line " + std::to_string(line) + " " + std::to_string(file) + "\n";
}

/// Whether a block comment is open after `line`, which starts inside one or not.
bool ends_in_comment(const std::string& line, bool inside) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        if (inside && line[i] == '*' && line[i + 1] == '/') {
            inside = false;
            ++i;
        } else if (!inside && line[i] == '/' && line[i + 1] == '/') {
            return false;
        } else if (!inside && line[i] == '/' && line[i + 1] == '*') {
            inside = true;
            ++i;
        }
    }
    return inside;
}

class Preprocessor {
  public:
    Preprocessor(const fs::path& folder, FileStamps& seen) : folder_(folder), seen_(seen) {}

    void add_entry(const std::string& entry, StageSource& out) {
        const fs::path path = (folder_ / entry).lexically_normal();
        if (!look_at(path))
            throw Error(entry + ": no such shader in " + folder_.string() +
                        "; check the program's file names");
        out.files = {entry, "generated code"};
        done_.insert(path);
        add_file(path, 0, out);
    }

    const std::string& extensions() const { return extensions_; }
    const std::string& body() const { return body_; }

  private:
    bool look_at(const fs::path& path) { return (seen_[path] = stamp_of(path)).has_value(); }

    void add_file(const fs::path& path, std::size_t number, StageSource& out) {
        open_.push_back(path);
        body_ += line_directive(1, number);
        std::ifstream in(path);
        bool in_comment = false;
        int line_number = 0;
        for (std::string line; std::getline(in, line);) {
            ++line_number;
            if (!line.empty() && line.back() == '\r') line.pop_back();
            if (in_comment || !add_directive(line, line_number, path, number, out)) body_ += line + "\n";
            in_comment = ends_in_comment(line, in_comment);
        }
        if (in.bad()) throw Error(out.files[number] + ": cannot be read");
        open_.pop_back();
    }

    /// Handles #include, #extension and #version; false for any other line.
    bool add_directive(const std::string& line, int line_number, const fs::path& path, std::size_t number,
                       StageSource& out) {
        static const std::regex directive(R"(^\s*#\s*(include|extension|version)\b\s*(.*)$)");
        std::smatch match;
        if (line.find('#') == std::string::npos || !std::regex_match(line, match, directive)) return false;
        const std::string place = out.files[number] + ":" + std::to_string(line_number) + ": ";
        if (match[1] == "version")
            throw Error(place + "#version is set by the program library; remove the line");
        if (match[1] == "extension") {
            extensions_ += line_directive(line_number, number) + line + "\n";
            body_ += "\n";
        } else {
            include(match[2], place, path, out);
            body_ += line_directive(line_number + 1, number);
        }
        return true;
    }

    void include(const std::string& argument, const std::string& place, const fs::path& from,
                 StageSource& out) {
        static const std::regex quoted(R"re("([^"]+)"\s*(//.*|/\*.*\*/\s*)?)re");
        std::smatch match;
        if (!std::regex_match(argument, match, quoted))
            throw Error(place + "write the include as #include \"folder/file.glsl\"");
        const std::string name = match[1];
        const fs::path path = resolve(name, place, from);
        if (const auto begin = std::find(open_.begin(), open_.end(), path); begin != open_.end())
            throw Error(place + "circular include: " + cycle(begin) + display_name(path));
        if (!done_.insert(path).second) return;
        out.files.push_back(display_name(path));
        add_file(path, out.files.size() - 1, out);
    }

    fs::path resolve(const std::string& name, const std::string& place, const fs::path& from) {
        const fs::path beside = (from.parent_path() / name).lexically_normal();
        if (look_at(beside)) return beside;
        const fs::path below = (folder_ / name).lexically_normal();
        if (look_at(below)) return below;
        throw Error(place + "include file \"" + name +
                    "\" does not exist, neither beside this file nor in the shader folder");
    }

    std::string display_name(const fs::path& path) const {
        return path.lexically_relative(folder_.lexically_normal()).generic_string();
    }

    std::string cycle(std::vector<fs::path>::const_iterator begin) const {
        std::string text;
        for (auto it = begin; it != open_.end(); ++it) text += display_name(*it) + " → ";
        return text;
    }

    const fs::path& folder_;
    FileStamps& seen_;
    std::vector<fs::path> open_;  ///< from the entry to the file being read
    std::set<fs::path> done_;
    std::string extensions_, body_;
};

}  // namespace

std::optional<FileStamp> stamp_of(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return std::nullopt;
    FileStamp stamp;
    stamp.time = fs::last_write_time(file, error);
    if (!error) stamp.bytes = fs::file_size(file, error);
    return error ? std::nullopt : std::optional(stamp);
}

StageSource preprocess(const fs::path& folder, const std::string& entry,
                       const std::map<std::string, std::string>& defines, const std::string& preamble,
                       FileStamps& seen) {
    StageSource stage;
    Preprocessor preprocessor(folder, seen);
    preprocessor.add_entry(entry, stage);
    stage.text = "#version 450 core\n" + preprocessor.extensions() + line_directive(1, 1);
    for (const auto& [name, value] : defines) stage.text += "#define " + name + " " + value + "\n";
    stage.text += preamble;
    if (!stage.text.ends_with('\n')) stage.text += '\n';
    stage.text += preprocessor.body();
    return stage;
}

}  // namespace ir::gl
