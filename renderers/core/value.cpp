#include "renderers/core/value.h"

#include <charconv>
#include <cmath>

namespace ir {

std::string to_string(const Value& value) {
    struct Visitor {
        std::string operator()(bool v) const { return v ? "true" : "false"; }
        std::string operator()(std::int64_t v) const { return std::to_string(v); }
        std::string operator()(double v) const {
            char text[40];
            return {text, std::to_chars(text, text + sizeof text, v).ptr};
        }
        std::string operator()(const std::string& v) const { return v; }
    };
    return std::visit(Visitor{}, value);
}

double as_written(float number) {
    if (!std::isfinite(number)) return number;
    char text[32];
    const auto* end = std::to_chars(text, text + sizeof text, number).ptr;
    double decimal = 0;
    std::from_chars(text, end, decimal);
    // Rounding twice, to double and to float, must not lead elsewhere.
    return static_cast<float>(decimal) == number ? decimal : number;
}

}  // namespace ir
