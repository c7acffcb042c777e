#include "renderers/gl/shader_log.h"

#include <charconv>
#include <optional>
#include <regex>
#include <sstream>

namespace ir::gl {
namespace {

struct Diagnostic {
    std::string line, kind, text;
};

std::optional<Diagnostic> parse(const std::string& text) {
    std::smatch match;
    static const std::regex mesa(R"(^\d+:(\d+)\(\d+\): (?:preprocessor )?(error|warning): (.*)$)");
    static const std::regex nvidia(R"(^\d+\((\d+)\) : (error|warning) (\w+: .*)$)");
    static const std::regex reference(R"(^(ERROR|WARNING): \d+:(\d+): (.*)$)");
    if (std::regex_match(text, match, mesa) || std::regex_match(text, match, nvidia))
        return Diagnostic{match[1], match[2], match[3]};
    if (std::regex_match(text, match, reference))
        return Diagnostic{match[2], match[1] == "ERROR" ? "error" : "warning", match[3]};
    return std::nullopt;
}

/// NVIDIA's driver begins the log of a program with "Compute info" and a line of dashes.
bool is_heading(const std::string& text) {
    static const std::regex heading(R"(^(?:\w+(?: \w+)? info|-+)$)");
    return std::regex_match(text, heading);
}

void trim_end(std::string& text) {
    text.erase(text.find_last_not_of(std::string("\0\r ", 3)) + 1);
}

}  // namespace

std::vector<std::string> shader_errors(const std::string& log,
                                       const std::function<std::string(std::size_t line)>& place_of) {
    std::vector<std::string> placed, others, warnings;
    std::istringstream lines(log);
    for (std::string text; std::getline(lines, text);) {
        trim_end(text);
        if (text.empty() || is_heading(text)) continue;
        const auto found = parse(text);
        std::size_t line = 0;
        if (found) std::from_chars(found->line.data(), found->line.data() + found->line.size(), line);
        const std::string place = found ? place_of(line) : "";
        if (place.empty())
            others.push_back(text);
        else
            (found->kind == "error" ? placed : warnings).push_back(place + ": " + found->text);
    }
    placed.insert(placed.end(), others.begin(), others.end());
    return placed.empty() ? warnings : placed;
}

}  // namespace ir::gl
