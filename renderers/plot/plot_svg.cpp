#include "renderers/plot/plot_svg.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "renderers/core/markup.h"
#include "renderers/plot/placed_plot.h"
#include "renderers/plot/plot_style.h"

namespace ir {
namespace {

constexpr double font = 12, title_font = 14, line_height = 20, tick_gap = 6, legend_gap = 20;
constexpr double right_margin = 18, bottom_margin = 46, mark_room = 30;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

std::string shortened(const std::string& text, double width) {
    if (width_of(text, font) <= width) return text;
    std::string result;
    for (const char c : text) {
        const bool is_letter = (static_cast<unsigned char>(c) & 0xc0) != 0x80;
        if (is_letter && width_of(result, font) + 2 * font > width) break;
        result += c;
    }
    return result + "…";
}

class Drawing {
  public:
    Drawing(const PlotData& data, int width, int height, bool is_file)
        : data_(data),
          style_(PlotStyle::paper()),
          width_(width),
          height_(height),
          is_file_(is_file),
          plot_(place_plot(data, width - 90.0, height - 90.0)) {}

    std::string svg() {
        lay_out();
        const auto w = std::to_string(width_), h = std::to_string(height_);
        out_.open("svg",
                  {{"xmlns", "http://www.w3.org/2000/svg"},
                   {"viewBox", "0 0 " + w + " " + h},
                   {"width", w},
                   {"height", h},
                   {"role", "img"},
                   {"aria-label", data_.title + ": " + data_.y.title + " over " + data_.x.title},
                   {"font-family", "system-ui, -apple-system, 'Segoe UI', Helvetica, Arial, sans-serif"},
                   {"font-size", number(font)}});
        if (is_file_) {
            out_.empty("rect",
                       {{"class", "ground"}, {"width", w}, {"height", h}, {"fill", style_.background}});
            text(12, 22, data_.title, "start", style_.text, "text", true);
        }
        if (plot_.heat) {
            draw_heat_legend();
            draw_axes();
            for (const auto& mark : plot_.marks) draw_tile(mark);
            return out_.close().str();
        }
        draw_legend();
        draw_axes();
        draw_level();
        draw_lines();
        for (const auto& mark : plot_.marks)
            if (mark.shown) draw_mark(mark);
        return out_.close().str();
    }

  private:
    void text(double x, double y, const std::string& words, const char* anchor, const PlotColour& colour,
              const char* name, bool is_title = false) {
        out_.line("text", words,
                  {{"x", number(x)},
                   {"y", number(y)},
                   {"text-anchor", anchor},
                   {"fill", colour},
                   {"class", name},
                   {is_title ? "font-weight" : "", "600"},
                   {is_title ? "font-size" : "", number(title_font)}});
    }

    void line(double x1, double y1, double x2, double y2, const PlotColour& colour, const std::string& name,
              double width, const char* dashes = nullptr) {
        out_.empty("line", {{"x1", number(x1)},
                            {"y1", number(y1)},
                            {"x2", number(x2)},
                            {"y2", number(y2)},
                            {"stroke", colour},
                            {"class", name},
                            {"stroke-width", number(width)},
                            {dashes ? "stroke-dasharray" : "", dashes ? dashes : ""}});
    }

    double x_at(double place) const {
        return left_ + (place - plot_.x.low()) / (plot_.x.high() - plot_.x.low()) * (right_ - left_);
    }
    double y_at(double place) const {
        return bottom_ - (place - plot_.y.low()) / (plot_.y.high() - plot_.y.low()) * (bottom_ - top_);
    }

    /// The legend first: entries after one another in as many lines as they need.
    void lay_out() {
        double widest = 0;
        for (const auto& tick : plot_.y.ticks()) widest = std::max(widest, width_of(tick.text, font));
        left_ = 34 + widest;
        right_ = width_ - right_margin;
        double x = 12, y = is_file_ ? 40 : 14;
        const auto add = [&](const std::string& words, int series) {
            const auto shown = shortened(words, width_ - 60.0);
            const double needed = mark_room + width_of(shown, font);
            if (x > 12 && x + needed > width_ - 12.0) x = 12, y += line_height;
            legend_.push_back({shown, series, x, y});
            x += needed + legend_gap;
        };
        if (plot_.heat) add(data_.heat->title, -1);
        for (std::size_t s = 0; s < data_.series.size() && !plot_.heat; ++s)
            add(data_.series[s].name, int(s));
        if (plot_.has_rings() && !data_.ring_name.empty()) add(data_.ring_name, -1);
        top_ = y + (legend_.empty() ? 0 : line_height);
        bottom_ = std::max(top_ + 40, height_ - bottom_margin);
    }

    void draw_legend() {
        for (const auto& entry : legend_) {
            const double x = entry.x + 12, y = entry.y;
            if (entry.series >= 0) {
                line(x - 12, y, x + 12, y, style_.series(entry.series), line_class(entry.series), 1.5);
                draw_shape(x, y, entry.series, mark_radius(0), false);
            } else {
                if (data_.join_rings) line(x - 12, y, x + 12, y, style_.front, "front", 1.2, "2 3");
                draw_ring(x, y, 6, true);
            }
            text(x + 18, y + 4, entry.text, "start", style_.text, "text");
        }
    }

    /// The colours with the least and the greatest value, and what they stand for.
    void draw_heat_legend() {
        constexpr double width = 120, height = 12;
        constexpr int steps = 24;
        const auto low = plot_number(plot_.heat->low), high = plot_number(plot_.heat->high);
        const double left = 12 + width_of(low, font) + tick_gap, y = legend_.front().y;
        text(12, y + 4, low, "start", style_.text, "text");
        for (int i = 0; i < steps; ++i)
            out_.empty("rect", {{"x", number(left + i * width / steps)},
                                {"y", number(y - height / 2)},
                                {"width", number(width / steps + 0.5)},
                                {"height", number(height)},
                                {"fill", plot_.heat->colour(plot_.heat->at((i + 0.5) / steps))}});
        text(left + width + tick_gap, y + 4, high + "  " + data_.heat->title, "start", style_.text, "text");
    }

    void draw_tile(const PlacedPlot::Mark& mark) {
        const double left = x_at(mark.x - 0.5), top = y_at(mark.y + 0.5);
        const double width = x_at(mark.x + 0.5) - left, height = y_at(mark.y - 0.5) - top;
        out_.open("g");
        if (const auto* point = data_.find(mark.id)) out_.line("title", point->label);
        out_.empty("rect", {{"x", number(left)},
                            {"y", number(top)},
                            {"width", number(width)},
                            {"height", number(height)},
                            {"fill", plot_.heat->colour(mark.value)},
                            {"class", "tile"}});
        if (width >= min_tile_width && height >= min_tile_height)
            text(left + width / 2, top + height / 2 + 4, plot_number(mark.value), "middle",
                 plot_.heat->ink(mark.value), "value");
        out_.close();
    }

    void draw_axes() {
        for (const auto& tick : plot_.y.ticks()) {
            const double y = y_at(tick.place);
            line(left_, y, right_, y, style_.grid, "grid", 1);
            text(left_ - tick_gap, y + 4, tick.text, "end", style_.text, "text");
        }
        const double room = plot_.x.ticks().empty() ? 0 : (right_ - left_) / double(plot_.x.ticks().size());
        for (const auto& tick : plot_.x.ticks()) {
            const double x = x_at(tick.place);
            line(x, top_, x, bottom_, style_.grid, "grid", 1);
            const auto words = data_.x.names.empty() ? tick.text : shortened(tick.text, room);
            text(x, bottom_ + 16, words, "middle", style_.text, "text");
        }
        line(left_, bottom_, right_, bottom_, style_.dim, "axis", 1);
        line(left_, top_, left_, bottom_, style_.dim, "axis", 1);
        text((left_ + right_) / 2, bottom_ + 36, data_.x.title, "middle", style_.text, "text");
        const auto middle = number((top_ + bottom_) / 2);
        out_.line("text", data_.y.title,
                  {{"transform", "translate(16 " + middle + ") rotate(-90)"},
                   {"text-anchor", "middle"},
                   {"fill", style_.text},
                   {"class", "text"}});
    }

    void draw_level() {
        if (!plot_.shows_level || plot_.marks.empty()) return;
        const double y = y_at(plot_.y.place(data_.level->y));
        line(left_, y, right_, y, style_.level, "level", 1.2, "7 4");
        text(right_ - 6, y - 16 > top_ ? y - 5 : y + 15, data_.level->label, "end", style_.dim, "dim");
    }

    void polyline(const std::vector<std::pair<double, double>>& places, const PlotColour& colour,
                  const std::string& name, const char* dashes) {
        std::string points;
        for (const auto& [x, y] : places) points += number(x_at(x)) + "," + number(y_at(y)) + " ";
        if (!points.empty()) points.pop_back();
        out_.empty("polyline", {{"points", points},
                                {"fill", "none"},
                                {"stroke", colour},
                                {"class", name},
                                {"stroke-width", "1.5"},
                                {dashes ? "stroke-dasharray" : "stroke-opacity", dashes ? dashes : "0.75"}});
    }

    void draw_lines() {
        std::vector<std::pair<double, double>> line, front;
        for (std::size_t i = 0; i < plot_.marks.size(); ++i) {
            const auto& mark = plot_.marks[i];
            line.emplace_back(mark.x, mark.y);
            if (mark.ring) front.emplace_back(mark.x, mark.y);
            if (i + 1 < plot_.marks.size() && !plot_.marks[i + 1].begins) continue;
            if (line.size() > 1) polyline(line, style_.series(mark.series), line_class(mark.series), nullptr);
            line.clear();
        }
        std::sort(front.begin(), front.end());
        if (data_.join_rings && front.size() > 1) polyline(front, style_.front, "front", "2 3");
    }

    std::string line_class(int series) const { return "line " + series_class(series); }
    std::string series_class(int series) const {
        return "s" + std::to_string(std::size_t(series) % style_.colours.size());
    }

    void draw_ring(double x, double y, double radius, bool is_filled) {
        out_.empty("circle", {{"cx", number(x)},
                              {"cy", number(y)},
                              {"r", number(radius)},
                              {"fill", is_filled ? style_.background : "none"},
                              {"stroke", style_.front},
                              {"class", is_filled ? "ring ground" : "ring"},
                              {"stroke-width", "1.5"}});
    }

    void draw_shape(double x, double y, int series, double radius, bool is_hollow) {
        const auto colour = style_.series(series);
        const auto fill = is_hollow ? style_.background : colour;
        const auto stroke = is_hollow ? colour : style_.background;
        const auto name = (is_hollow ? "hollow " : "mark ") + series_class(series);
        const auto corners = mark_corners(series);
        if (corners.empty()) {
            out_.empty("circle", {{"cx", number(x)},
                                  {"cy", number(y)},
                                  {"r", number(radius)},
                                  {"fill", fill},
                                  {"stroke", stroke},
                                  {"class", name}});
            return;
        }
        std::string points;
        for (const auto& [dx, dy] : corners)
            points += number(x + radius * dx) + "," + number(y + radius * dy) + " ";
        points.pop_back();
        out_.empty("polygon", {{"points", points}, {"fill", fill}, {"stroke", stroke}, {"class", name}});
    }

    void draw_mark(const PlacedPlot::Mark& mark) {
        const double x = x_at(mark.x), y = y_at(mark.y), radius = mark_radius(plot_.marks.size());
        out_.open("g");
        if (const auto* point = data_.find(mark.id)) out_.line("title", point->label);
        draw_shape(x, y, mark.series, radius, mark.displaced);
        if (mark.ring) draw_ring(x, y, radius + 3, false);
        out_.close();
    }

    struct Entry {
        std::string text;
        int series;  ///< -1: the rings
        double x, y;
    };
    const PlotData& data_;
    const PlotStyle& style_;
    const int width_, height_;
    const bool is_file_;
    const PlacedPlot plot_;
    std::vector<Entry> legend_;
    double left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
    Markup out_;
};

}  // namespace

std::string plot_svg(const PlotData& data, int width, int height, bool is_file) {
    return Drawing(data, width, height, is_file).svg() + (is_file ? "\n" : "");
}

}  // namespace ir
