#include "app/engine/number_text.h"

#include <cmath>
#include <cstdio>
#include <limits>

namespace ir::engine {

projects::Json number_json(double value) {
    return std::isfinite(value) ? projects::Json(value) : projects::Json();
}

double number_from(const projects::Json& json, const std::string& reason,
                   const projects::ObjectReader& reader, const std::string& key) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (json.is_number()) return json.get<double>();
    if (json == "inf" || (json.is_null() && reason.starts_with("infinite"))) return infinity;
    if (json == "-inf" || (json.is_null() && reason.starts_with("minus infinite"))) return -infinity;
    if (json == "nan" || json.is_null()) return std::nan("");
    reader.fail(key, "must be a number or null");
}

std::vector<std::string> read_texts(projects::ObjectReader& reader, const std::string& key) {
    std::vector<std::string> texts;
    reader.each(key, [&](const projects::Json& json, const std::string&) {
        if (!json.is_string()) reader.fail(key, "must be an array of texts");
        texts.push_back(json);
    });
    return texts;
}

std::string csv_value(const projects::Json& value) {
    return value.is_null() ? "" : csv_field(value.is_string() ? value.get<std::string>() : value.dump());
}

std::string csv_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

}  // namespace ir::engine
