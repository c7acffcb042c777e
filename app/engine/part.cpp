#include "app/engine/part.h"

#include <charconv>

namespace ir::engine {
namespace {

constexpr const char *level_mark = ".level", *layer_mark = ".layer";

/// Takes "MARK" and a number off the end; 0 where the name has none there.
int take_number(std::string& name, const std::string& mark) {
    const auto at = name.rfind(mark);
    if (at == std::string::npos) return 0;
    int number = 0;
    const char *begin = name.data() + at + mark.size(), *end = name.data() + name.size();
    const auto read = std::from_chars(begin, end, number);
    if (begin == end || *begin == '-' || read.ec != std::errc() || read.ptr != end) return 0;
    name.resize(at);
    return number;
}

}  // namespace

std::string layer_name(const Part& part, bool has_layers) {
    auto name = part.key;
    if (part.level > 0) name += level_mark + std::to_string(part.level);
    if (has_layers) name += layer_mark + std::to_string(part.layer);
    return name;
}

Part part_called(const std::string& name) {
    Part part{name};
    part.layer = take_number(part.key, layer_mark);
    part.level = take_number(part.key, level_mark);
    return part;
}

}  // namespace ir::engine
