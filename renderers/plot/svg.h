#pragma once

#include <cstdio>
#include <string>

#include "renderers/core/markup.h"

/// What all drawings in SVG share.
namespace ir {

inline std::string svg_number(double value, int decimals) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

/// Opens the drawing's element; `label` says what it shows to those who do not see it.
inline void open_svg(Markup& out, const std::string& width, const std::string& height,
                     const std::string& label, const std::string& font_size) {
    out.open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                     {"viewBox", "0 0 " + width + " " + height},
                     {"width", width},
                     {"height", height},
                     {"role", "img"},
                     {"aria-label", label},
                     {"font-family", "system-ui, -apple-system, 'Segoe UI', Helvetica, Arial, sans-serif"},
                     {"font-size", font_size}});
}

}  // namespace ir
