#include "renderers/plot/plot_svg.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "renderers/core/markup.h"
#include "renderers/plot/plot_drawing.h"
#include "renderers/plot/plot_style.h"
#include "renderers/plot/svg.h"

namespace ir {
namespace {

constexpr double font = 12, title_font = 14, text_line = 20;
constexpr double half_height = font / 3;  ///< of small letters, from their feet

std::string number(double value) {
    return svg_number(value, 2);
}

std::string joined(const std::vector<double>& numbers) {
    std::string text;
    for (const double each : numbers) text += (text.empty() ? "" : " ") + number(each);
    return text;
}

class SvgCanvas : public PlotCanvas {
  public:
    explicit SvgCanvas(Markup& out) : out_(out) {}

    double line_height() const override { return text_line; }
    double width_of(const std::string& words, Letters letters) const override {
        return ir::width_of(words, letters == Letters::title ? title_font : font);
    }

    void text(Place at, const std::string& words, Anchor anchor, const Ink& ink, Letters letters) override {
        const bool is_title = letters == Letters::title, is_upwards = letters == Letters::upwards;
        const auto x = number(is_upwards ? at.x + half_height : at.x),
                   y = number(is_upwards ? at.y : at.y + half_height);
        out_.line("text", words,
                  {{is_upwards ? "" : "x", x},
                   {is_upwards ? "" : "y", y},
                   {is_upwards ? "transform" : "", "translate(" + x + " " + y + ") rotate(-90)"},
                   {"text-anchor", anchor == Anchor::start    ? "start"
                                   : anchor == Anchor::middle ? "middle"
                                                              : "end"},
                   {"fill", ink.colour},
                   {"class", ink.name},
                   {is_title ? "font-weight" : "", "600"},
                   {is_title ? "font-size" : "", number(title_font)}});
    }

    void line(const std::vector<Place>& places, const Ink& ink, const Stroke& stroke) override {
        std::vector<std::pair<double, double>> points;
        for (const auto& [x, y] : places) points.emplace_back(x, y);
        out_.empty("polyline", {{"points", points_of(points)},
                                {"fill", "none"},
                                {"stroke", ink.colour},
                                {"class", ink.name},
                                {"stroke-width", number(stroke.width)},
                                {stroke.dashes.empty() ? "" : "stroke-dasharray", joined(stroke.dashes)},
                                {stroke.opacity == 1 ? "" : "stroke-opacity", number(stroke.opacity)}});
    }

    void shape(const Shape& shape) override {
        const auto& [x, y] = shape.centre;
        const bool is_circle = shape.corners.empty();
        std::vector<std::pair<double, double>> corners;
        for (const auto& [dx, dy] : shape.corners)
            corners.emplace_back(x + shape.radius * dx, y + shape.radius * dy);
        out_.empty(is_circle ? "circle" : "polygon",
                   {{is_circle ? "" : "points", points_of(corners)},
                    {is_circle ? "cx" : "", number(x)},
                    {is_circle ? "cy" : "", number(y)},
                    {is_circle ? "r" : "", number(shape.radius)},
                    {"fill", shape.fill.empty() ? "none" : shape.fill},
                    {"stroke", shape.outline},
                    {"class", shape.name},
                    {shape.outline_width == 1 ? "" : "stroke-width", number(shape.outline_width)}});
    }

    void box(const Box& box, const Ink& ink) override {
        out_.empty("rect", {{"x", number(box.left)},
                            {"y", number(box.top)},
                            {"width", number(box.width())},
                            {"height", number(box.height())},
                            {"fill", ink.colour},
                            {"class", ink.name}});
    }

    void begin_point(const PlotPoint& point) override { out_.open("g").line("title", point.label); }
    void end_point() override { out_.close(); }

  private:
    static std::string points_of(const std::vector<std::pair<double, double>>& places) {
        std::string text;
        for (const auto& [x, y] : places) text += (text.empty() ? "" : " ") + number(x) + "," + number(y);
        return text;
    }

    Markup& out_;
};

}  // namespace

int plot_svg_height_of(const PlotData& data) {
    return data.are_bars ? std::max(plot_svg_height / 2, int(PlotDrawing::height_of_rows(data, text_line)))
                         : plot_svg_height;
}

std::string plot_svg(const PlotData& data, int width, int height, bool is_file) {
    const auto w = std::to_string(width), h = std::to_string(height);
    const auto& style = PlotStyle::paper();
    Markup out;
    SvgCanvas canvas(out);
    open_svg(out, w, h, data.title + ": " + data.y.title + " over " + data.x.title, number(font));
    if (is_file) canvas.box({0, 0, double(width), double(height)}, {style.background, "ground"});
    PlotDrawing(data, style, width, height, is_file, canvas).draw(canvas);
    return out.close().str() + (is_file ? "\n" : "");
}

}  // namespace ir
