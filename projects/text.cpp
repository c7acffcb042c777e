#include "projects/text.h"

#include <ctime>

#include "renderers/core/first_character.h"

namespace ir::projects {

std::string printable(std::string_view text, std::size_t longest) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const auto [bytes, is_control] = first_character(text.substr(at));
        if (at + bytes > longest) return result + "…";
        result += is_control ? "?" : text.substr(at, bytes);
        at += bytes;
    }
    return result;
}

std::string pointer_to(const std::string& parent, std::string_view key) {
    std::string result = parent + "/";
    for (const char c : key) {
        if (c == '~')
            result += "~0";
        else if (c == '/')
            result += "~1";
        else
            result += c;
    }
    return result;
}

std::string pointer_to(const std::string& parent, std::size_t index) {
    return parent + "/" + std::to_string(index);
}

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

}  // namespace ir::projects
