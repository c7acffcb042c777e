#include "renderers/core/bytes_text.h"

#include <cstdio>

namespace ir {

std::string bytes_text(std::uint64_t bytes) {
    if (bytes < 1024) return std::to_string(bytes) + " B";
    double value = double(bytes);
    const char* unit = "B";
    for (const char* next : {"KiB", "MiB", "GiB"}) {
        if (value < 1024) break;
        value /= 1024;
        unit = next;
    }
    char text[32];
    std::snprintf(text, sizeof text, "%.*f %s", value < 10 ? 2 : value < 100 ? 1 : 0, value, unit);
    return text;
}

}  // namespace ir
