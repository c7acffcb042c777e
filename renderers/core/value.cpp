#include "renderers/core/value.h"

#include <charconv>
#include <cmath>

namespace ir {
namespace {

template <class Real>
std::string shortest(Real number) {
    if (std::isnan(number)) return "nan";  // whatever its sign
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

}  // namespace

std::string shortest_text(double number) {
    return shortest(number);
}

std::string shortest_text(float number) {
    return shortest(number);
}

std::string to_string(const Value& value) {
    struct Visitor {
        std::string operator()(bool v) const { return v ? "true" : "false"; }
        std::string operator()(std::int64_t v) const { return std::to_string(v); }
        std::string operator()(double v) const { return shortest_text(v); }
        std::string operator()(const std::string& v) const { return v; }
    };
    return std::visit(Visitor{}, value);
}

double as_written(float number) {
    if (!std::isfinite(number)) return number;
    const auto text = shortest_text(number);
    double decimal = 0;
    std::from_chars(text.data(), text.data() + text.size(), decimal);
    // Rounding twice, to double and to float, must not lead elsewhere.
    return static_cast<float>(decimal) == number ? decimal : number;
}

}  // namespace ir
