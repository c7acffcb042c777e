#include "renderers/gl/preprocessor.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "renderers/core/error.h"
#include "renderers/core/words.h"

namespace ir::gl {
namespace {

namespace fs = std::filesystem;

struct Line {
    std::string text;
    StageSource::Place place;
};

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
    Preprocessor(const fs::path& folder, const ShaderChanges& changes, FileStamps& seen)
        : folder_(folder), changes_(changes), seen_(seen) {}

    void read_entry(const std::string& entry) {
        const fs::path path = (folder_ / entry).lexically_normal();
        if (!look_at(path))
            throw Error(entry + ": no such shader in " + folder_.string() +
                        "; check the program's file names");
        files_ = {entry, "generated code"};
        done_.insert(path);
        read(path, 0);
    }

    const std::vector<std::string>& files() const { return files_; }
    const std::vector<Line>& extensions() const { return extensions_; }
    const std::vector<Line>& body() const { return body_; }

  private:
    bool look_at(const fs::path& path) { return (seen_[path] = stamp_of(path)).has_value(); }

    void read(const fs::path& path, std::size_t file) {
        open_.push_back(path);
        std::istringstream in(text_of(path, files_[file]));
        bool in_comment = false;
        int number = 0;
        for (std::string text; std::getline(in, text);) {
            if (!text.empty() && text.back() == '\r') text.pop_back();
            const Line line{text, {file, ++number}};
            if (in_comment || !is_directive(line, path)) body_.push_back(line);
            in_comment = ends_in_comment(text, in_comment);
        }
        open_.pop_back();
    }

    std::string text_of(const fs::path& path, const std::string& name) const {
        if (const auto change = changes_.find(display_name(path)); change != changes_.end())
            return changed_shader(folder_, change->first, change->second);
        std::ostringstream text;
        std::ifstream in(path);
        if (in.is_open() && in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
        if (!in.is_open() || in.bad()) throw Error(name + ": cannot be read; check the file's permissions");
        return text.str();
    }

    /// Handles #include, #extension and #version; false for any other line.
    bool is_directive(const Line& line, const fs::path& path) {
        static const std::regex directive(R"(^\s*#\s*(include|extension|version)\b\s*(.*)$)");
        std::smatch match;
        if (line.text.find('#') == std::string::npos || !std::regex_match(line.text, match, directive))
            return false;
        const std::string place = files_[line.place.file] + ":" + std::to_string(line.place.line) + ": ";
        if (match[1] == "version")
            throw Error(place + "#version is set by the program library; remove the line");
        if (match[1] == "extension")
            extensions_.push_back(line);
        else
            include(match[2], place, path);
        return true;
    }

    void include(const std::string& argument, const std::string& place, const fs::path& from) {
        static const std::regex quoted(R"re("([^"]+)"\s*(//.*|/\*.*\*/\s*)?)re");
        std::smatch match;
        if (!std::regex_match(argument, match, quoted))
            throw Error(place + "write the include as #include \"folder/file.glsl\"");
        const fs::path path = resolve(match[1], place, from);
        if (const auto begin = std::find(open_.begin(), open_.end(), path); begin != open_.end())
            throw Error(place + "circular include: " + cycle(begin) + display_name(path));
        if (!done_.insert(path).second) return;
        files_.push_back(display_name(path));
        read(path, files_.size() - 1);
    }

    fs::path resolve(const std::string& name, const std::string& place, const fs::path& from) {
        bool is_inside = false;
        for (const auto& folder : {from.parent_path(), folder_}) {
            const fs::path path = (folder / name).lexically_normal();
            const auto inside = path.lexically_relative(folder_.lexically_normal());
            if (inside.empty() || *inside.begin() == "..") continue;
            is_inside = true;
            if (look_at(path)) return path;
        }
        throw Error(place + "include file \"" + name + "\" " +
                    (is_inside ? "does not exist, neither beside this file nor in the shader folder"
                               : "leads out of the shader folder"));
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
    const ShaderChanges& changes_;
    FileStamps& seen_;
    std::vector<fs::path> open_;  ///< from the entry to the file being read
    std::set<fs::path> done_;
    std::vector<std::string> files_;
    std::vector<Line> extensions_, body_;
};

void add_generated(StageSource& stage, const std::string& text) {
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) stage.add(line, {1, ++number});
}

}  // namespace

std::optional<FileStamp> stamp_of(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return std::nullopt;
    FileStamp stamp;
    stamp.time = fs::last_write_time(file, error);
    if (!error) stamp.bytes = fs::file_size(file, error);
    return error ? std::nullopt : std::optional(stamp);
}

std::string StageSource::place_of(std::size_t line) const {
    if (line == 0 || line > places.size()) return {};
    const Place& place = places[line - 1];
    return files.at(place.file) + ":" + std::to_string(place.line);
}

StageSource::Line StageSource::line(std::size_t number) const {
    if (number == 0 || number > places.size()) return {};
    std::istringstream lines(text);
    Line line{place_of(number), {}, places[number - 1].line};
    for (std::size_t i = 0; i < number; ++i) std::getline(lines, line.text);
    line.text = trimmed(line.text);
    return line;
}

void StageSource::add(const std::string& line, Place place) {
    text += line + "\n";
    places.push_back(place);
}

StageSource preprocess(const fs::path& folder, const std::string& entry,
                       const std::map<std::string, std::string>& defines, const std::string& preamble,
                       const ShaderChanges& changes, FileStamps& seen) {
    Preprocessor preprocessor(folder, changes, seen);
    preprocessor.read_entry(entry);
    StageSource stage;
    stage.files = preprocessor.files();
    add_generated(stage, "#version 450 core");
    for (const auto& line : preprocessor.extensions()) stage.add(line.text, line.place);
    std::string generated;
    for (const auto& [name, value] : defines) generated += "#define " + name + " " + value + "\n";
    add_generated(stage, generated + preamble);
    for (const auto& line : preprocessor.body()) stage.add(line.text, line.place);
    return stage;
}

}  // namespace ir::gl
