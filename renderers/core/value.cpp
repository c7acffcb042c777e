#include "renderers/core/value.h"

#include <charconv>

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

}  // namespace ir
