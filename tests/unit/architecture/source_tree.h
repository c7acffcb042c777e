#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace ir::test {

/// One file of the project as its text.
struct SourceFile {
    std::string path;  ///< relative to the root, with '/'
    std::string text;
    bool is_header() const { return path.ends_with(".h"); }
};

inline std::string read_text(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// All files below the given folders of the root whose names end in one of the endings.
inline std::vector<SourceFile> source_files(const std::vector<std::string>& folders,
                                            const std::vector<std::string>& endings) {
    std::vector<SourceFile> files;
    const std::filesystem::path root = SOURCE_ROOT;
    for (const auto& folder : folders) {
        if (!std::filesystem::exists(root / folder)) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            const auto path = entry.path().lexically_relative(root).generic_string();
            const bool fits = std::any_of(endings.begin(), endings.end(),
                                          [&](const auto& ending) { return path.ends_with(ending); });
            if (fits && entry.is_regular_file()) files.push_back({path, read_text(entry.path())});
        }
    }
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
    return files;
}

/// What a C++ or GLSL text includes: in quotes and in angle brackets.
struct Includes {
    std::vector<std::string> own, system;
};
inline Includes includes_of(const std::string& text) {
    static const std::regex pattern(R"([ \t]*#[ \t]*include[ \t]*(["<])([^">]+)[">].*)");
    Includes result;
    std::istringstream lines(text);
    std::smatch match;
    for (std::string line; std::getline(lines, line);)
        if (line.find('#') != std::string::npos && std::regex_match(line, match, pattern))
            (match[1] == "\"" ? result.own : result.system).push_back(match[2]);
    return result;
}

/// Text without // and /* */ comments; string literals stay.
inline std::string without_comments(const std::string& text) {
    std::string result;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (in_string) {
            result += text[i];
            if (text[i] == '\\' && i + 1 < text.size())
                result += text[++i];
            else if (text[i] == '"' || text[i] == '\n')
                in_string = false;
        } else if (text.compare(i, 2, "//") == 0) {
            while (i < text.size() && text[i] != '\n') ++i;
            result += '\n';
        } else if (text.compare(i, 2, "/*") == 0) {
            const auto end = text.find("*/", i + 2);
            i = end == std::string::npos ? text.size() : end + 1;
        } else {
            in_string = text[i] == '"' && (i == 0 || text[i - 1] != '\'');
            result += text[i];
        }
    }
    return result;
}

/// Names of the folders in a folder of the root.
inline std::set<std::string> folders_in(const std::string& folder) {
    std::set<std::string> names;
    const auto path = std::filesystem::path(SOURCE_ROOT) / folder;
    if (!std::filesystem::exists(path)) return names;
    for (const auto& entry : std::filesystem::directory_iterator(path))
        if (entry.is_directory()) names.insert(entry.path().filename().string());
    return names;
}

inline const std::vector<std::string> code_folders{"app", "widgets", "projects", "renderers"};

}  // namespace ir::test
