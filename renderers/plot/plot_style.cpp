#include "renderers/plot/plot_style.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "renderers/core/constants.h"

namespace ir {
namespace {

/// A regular polygon or, with `inner` below 1, a star; the first corner at `start` turns from the top.
struct Shape {
    int corners;
    double start, inner, size;  ///< how large it is for equal weight
};
constexpr std::array<Shape, 7> shapes{{{4, 0.125, 1, 1.2},
                                       {3, 0, 1, 1.35},
                                       {4, 0, 1, 1.3},
                                       {3, 0.5, 1, 1.35},
                                       {5, 0, 0.45, 1.5},
                                       {6, 0, 1, 1.15},
                                       {4, 0, 0.4, 1.5}}};

}  // namespace

// Eight hues that people with any colour vision can tell apart [Okabe08], black exchanged for light grey on
// the dark ground and yellow darkened on the white one.
const PlotStyle& PlotStyle::screen() {
    static const PlotStyle style{
        "#242424", "#dedede",
        "#a0a0a0", "#3e3e3e",
        "#f0f0f0", "#b0b0b0",
        "#ffffff", {"#56b4e9", "#e69f00", "#00b284", "#f0e442", "#e86816", "#cc79a7", "#4a86d0", "#c8c8c8"}};
    return style;
}

const PlotStyle& PlotStyle::paper() {
    static const PlotStyle style{
        "#ffffff", "#141414",
        "#505050", "#dadada",
        "#282828", "#5a5a5a",
        "#000000", {"#0072b2", "#d55e00", "#009e73", "#b28e00", "#56b4e9", "#b45488", "#e69f00", "#5a5a5a"}};
    return style;
}

double width_of(const std::string& text, double font) {
    const auto letters = std::count_if(text.begin(), text.end(),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
    return 0.58 * font * double(letters);
}

PlotColour plot_colour(const Tint& tint) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", tint[0], tint[1], tint[2]);
    return text;
}

PlotColour mixed(const PlotColour& a, const PlotColour& b, double fraction) {
    const auto channel = [&](std::size_t at) {
        const double from = std::stoi(a.substr(at, 2), nullptr, 16),
                     to = std::stoi(b.substr(at, 2), nullptr, 16);
        return std::uint8_t(std::lround(from + (to - from) * fraction));
    };
    return plot_colour({channel(1), channel(3), channel(5)});
}

std::vector<std::pair<double, double>> mark_corners(int series) {
    const int colours = int(PlotStyle::paper().colours.size());
    const std::size_t kind = std::size_t(series + series / colours) % (1 + shapes.size());
    std::vector<std::pair<double, double>> result;
    if (kind == 0) return result;
    const auto& [corners, start, inner, size] = shapes[kind - 1];
    const int count = inner < 1 ? 2 * corners : corners;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * pi * (start + double(i) / count);
        const double radius = size * (inner < 1 && i % 2 == 1 ? inner : 1);
        result.emplace_back(std::sin(angle) * radius, -std::cos(angle) * radius);
    }
    return result;
}

}  // namespace ir
