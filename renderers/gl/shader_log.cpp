#include "renderers/gl/shader_log.h"

#include <optional>
#include <regex>
#include <sstream>

namespace ir::gl {
namespace {

struct Diagnostic {
    std::string place, kind, text;
};

std::string place_of(const std::string& file, const std::string& line,
                     const std::vector<std::string>& files) {
    try {
        return files.at(std::stoul(file)) + ":" + line;
    } catch (const std::logic_error&) {
        return file + ":" + line;  // not a string number of ours
    }
}

std::optional<Diagnostic> parse(const std::string& line, const std::vector<std::string>& files) {
    std::smatch match;
    static const std::regex mesa(R"(^(\d+):(\d+)\(\d+\): (?:preprocessor )?(error|warning): (.*)$)");
    if (std::regex_match(line, match, mesa))
        return Diagnostic{place_of(match[1], match[2], files), match[3], match[4]};
    static const std::regex nvidia(R"(^(\d+)\((\d+)\) : (error|warning) (\w+: .*)$)");
    if (std::regex_match(line, match, nvidia))
        return Diagnostic{place_of(match[1], match[2], files), match[3], match[4]};
    static const std::regex reference(R"(^(ERROR|WARNING): (\d+):(\d+): (.*)$)");
    if (std::regex_match(line, match, reference))
        return Diagnostic{place_of(match[2], match[3], files), match[1] == "ERROR" ? "error" : "warning",
                          match[4]};
    return std::nullopt;
}

}  // namespace

std::vector<std::string> shader_errors(const std::string& log, const std::vector<std::string>& files) {
    std::vector<std::string> placed, others, warnings;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        while (!line.empty() && (line.back() == '\0' || line.back() == '\r' || line.back() == ' '))
            line.pop_back();
        if (line.empty()) continue;
        const auto found = parse(line, files);
        if (!found)
            others.push_back(line);
        else if (found->kind == "error")
            placed.push_back(found->place + ": " + found->text);
        else
            warnings.push_back(found->place + ": " + found->text);
    }
    // What has a place comes first: the first error is what users see.
    placed.insert(placed.end(), others.begin(), others.end());
    return placed.empty() ? warnings : placed;
}

}  // namespace ir::gl
