#include "app/engine/number_text.h"

#include <cmath>
#include <cstdio>

namespace ir::engine {

projects::Json number_json(double value) {
    return std::isfinite(value) ? projects::Json(value) : projects::Json();
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

std::string csv_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

}  // namespace ir::engine
