#include "renderers/plot/plot_drawing.h"

#include <algorithm>
#include <cmath>

namespace ir {
namespace {

using Anchor = PlotCanvas::Anchor;
using Box = PlotCanvas::Box;
using Letters = PlotCanvas::Letters;
using Place = PlotCanvas::Place;
using Stroke = PlotCanvas::Stroke;

constexpr double margin = 12, right_margin = 18, tick_gap = 6, legend_gap = 20;
constexpr double sample_width = 24;  ///< of a line in the legend, its mark in the middle
constexpr double mark_room = sample_width + tick_gap;
constexpr double rough_margins = 90;  ///< beside the axes, before texts are measured
// In lines of text.
constexpr double title_row = 0.9, first_row = 0.7, rows_below_title = 2;
constexpr double tick_row = 0.6, axis_title_row = 1.6, bottom_margin = 2.3, axes_keep = 4;
constexpr double bar_row = 0.9, beside_bars = 5.5;  ///< a row of bars; title, legend and axis
constexpr std::size_t title_lines = 2;
constexpr double min_axes = 40;
constexpr double bars_part = 0.76;  ///< of their row
constexpr double min_bar = 1.5;     ///< logical pixels: what is nothing is seen, too
constexpr double names_part = 0.4;  ///< of the width, that names of rows take at most
constexpr double swatch = 12;
constexpr int rings_entry = -1, heat_entry = -2, rest_entry = -3;  ///< of the legend, in place of a series

bool begins_letter(char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
}

/// As many letters as there is room for.
std::string shortened(const PlotCanvas& measure, const std::string& words, double width,
                      Letters letters = Letters::plain) {
    if (measure.width_of(words, letters) <= width) return words;
    std::string result;
    for (std::size_t end = 1; end <= words.size(); ++end) {
        if (end < words.size() && !begins_letter(words[end])) continue;
        if (measure.width_of(words.substr(0, end) + "…", letters) > width) break;
        result = words.substr(0, end);
    }
    return result + "…";
}

/// Lines of a title, broken between words; what there is no room for is left out of the last one.
std::vector<std::string> title_of(const PlotCanvas& measure, const std::string& words, double width) {
    std::vector<std::string> lines;
    if (words.empty()) return lines;
    auto rest = shortened(measure, words, double(title_lines) * width, Letters::title);
    while (!rest.empty()) {
        std::size_t end = rest.size();
        while (end != std::string::npos && measure.width_of(rest.substr(0, end), Letters::title) > width)
            end = end == 0 ? std::string::npos : rest.rfind(' ', end - 1);
        if (end == std::string::npos || end == 0 || lines.size() + 1 == title_lines) {
            lines.push_back(shortened(measure, rest, width, Letters::title));
            break;
        }
        lines.push_back(rest.substr(0, end));
        rest.erase(0, end == rest.size() ? end : end + 1);
    }
    return lines;
}

/// The middle of a text that would rather stand at `wanted`, such that all of it lies between the margins.
double kept_inside(double wanted, double width, double room) {
    const double half = std::min(width / 2 + 4, room / 2);
    return std::clamp(wanted, half, room - half);
}

std::string series_name(const PlotStyle& style, int series) {
    return "s" + std::to_string(std::size_t(series) % style.colours.size());
}

void draw_ring(PlotCanvas& canvas, Place centre, double radius, const PlotStyle& style, bool is_filled) {
    canvas.shape({centre,
                  radius,
                  {},
                  is_filled ? style.background : PlotColour(),
                  style.front,
                  1.5,
                  is_filled ? "ring ground" : "ring"});
}

const Stroke series_stroke{1.5, {}, 0.75}, front_stroke{1.2, {2, 3}}, level_stroke{1.2, {7, 4}};

}  // namespace

void draw_plot_mark(PlotCanvas& canvas, Place centre, int series, double radius, const PlotStyle& style,
                    bool is_hollow) {
    const auto& colour = style.series(series);
    canvas.shape({centre, radius, mark_corners(series), is_hollow ? style.background : colour,
                  is_hollow ? colour : style.background, is_hollow ? 1.5 : 1,
                  (is_hollow ? "hollow " : "mark ") + series_name(style, series)});
}

PlotDrawing::PlotDrawing(const PlotData& data, const PlotStyle& style, double width, double height,
                         bool has_title, const PlotCanvas& measure)
    : data_(data),
      style_(style),
      width_(width),
      height_(height),
      title_(has_title ? title_of(measure, data.title, width - 2 * margin) : std::vector<std::string>()),
      plot_(place_plot(data, width - rough_margins, height - rough_margins)) {
    lay_out_legend(measure);
    const double line = measure.line_height();
    double widest = 0;
    for (const auto& tick : plot_.y.ticks())
        widest = std::max(widest, std::min(measure.width_of(tick.text), name_room()));
    area_.left = line + widest + 2 * tick_gap + 2;
    area_.right = std::max(area_.left + min_axes, width - right_margin);
    area_.top = legend_.empty() ? line * first_line() : legend_.back().at.y + line;
    area_.bottom = std::max(area_.top + min_axes, height - bottom_margin * line);
}

double PlotDrawing::height_of_rows(const PlotData& data, double line_height) {
    return data.are_bars ? line_height * (beside_bars + bar_row * double(data.y.names.size())) : 0;
}

double PlotDrawing::first_line() const {
    return title_.empty() ? first_row : rows_below_title + double(title_.size()) - 1;
}

/// Entries after one another, below the title, in as many rows as they need and the axes leave.
void PlotDrawing::lay_out_legend(const PlotCanvas& measure) {
    const double line = measure.line_height(), last = height_ - (bottom_margin + axes_keep) * line;
    double x = margin, y = line * first_line();
    int rest = 0;
    const auto add = [&](const std::string& words, int series) {
        const auto shown = shortened(measure, words, width_ - 2 * margin - mark_room);
        const double needed = mark_room + measure.width_of(shown);
        const bool is_full = x > margin && x + needed > width_ - margin;
        if (rest > 0 || (is_full && y + line > last)) {
            ++rest;
            return;
        }
        if (is_full) x = margin, y += line;
        legend_.push_back({shown, series, {x, y}});
        x += needed + legend_gap;
    };
    if (plot_.heat) return add(data_.heat->title, heat_entry);
    for (std::size_t s = 0; s < data_.series.size(); ++s)
        if (!data_.are_bars || !data_.series[s].name.empty()) add(data_.series[s].name, int(s));
    if (plot_.has_rings() && !data_.ring_name.empty()) add(data_.ring_name, rings_entry);
    if (rest == 0) return;
    const auto words = [&] { return "and " + std::to_string(rest) + " more"; };
    for (; x > margin && x + measure.width_of(words()) > width_ - margin; ++rest) {
        x = legend_.back().at.x;
        legend_.pop_back();
    }
    legend_.push_back({words(), rest_entry, {x, y}});
}

double PlotDrawing::x_at(double place) const {
    return area_.left + (place - plot_.x.low()) / (plot_.x.high() - plot_.x.low()) * area_.width();
}

double PlotDrawing::y_at(double place) const {
    return area_.bottom - (place - plot_.y.low()) / (plot_.y.high() - plot_.y.low()) * area_.height();
}

double PlotDrawing::name_room() const {
    return data_.y.names.empty() ? width_ : names_part * width_;
}

Box PlotDrawing::box(const Mark& mark) const {
    if (!data_.are_bars)
        return {x_at(mark.x - 0.5), y_at(mark.y + 0.5), x_at(mark.x + 0.5), y_at(mark.y - 0.5)};
    const double part = bars_part / double(data_.series.size());
    const double top = mark.y + bars_part / 2 - part * mark.series;
    const double left = x_at(std::min(mark.x, mark.value)), right = x_at(std::max(mark.x, mark.value));
    return {left, y_at(top), std::max(right, left + min_bar), y_at(top - part)};
}

void PlotDrawing::draw(PlotCanvas& canvas) const {
    draw_title(canvas);
    plot_.heat ? draw_heat_legend(canvas) : draw_legend(canvas);
    draw_axes(canvas);
    draw_axis_titles(canvas);
    if (plot_.heat) {
        for (const auto& mark : plot_.marks) draw_tile(canvas, mark);
        return;
    }
    if (data_.are_bars) return draw_bars(canvas);
    draw_level(canvas);
    draw_lines(canvas);
    for (const auto& mark : plot_.marks) {
        if (!mark.shown) continue;
        canvas.begin_point(point(mark));
        draw_mark(canvas, mark);
        canvas.end_point();
    }
}

void PlotDrawing::draw_title(PlotCanvas& canvas) const {
    for (std::size_t i = 0; i < title_.size(); ++i)
        canvas.text({margin, (title_row + double(i)) * canvas.line_height()}, title_[i], Anchor::start,
                    {style_.text, "text"}, Letters::title);
}

void PlotDrawing::draw_axes(PlotCanvas& canvas) const {
    const PlotCanvas::Ink grid{style_.grid, "grid"}, text{style_.text, "text"}, axis{style_.dim, "axis"};
    for (const auto& tick : plot_.y.ticks()) {
        const double y = y_at(tick.place);
        canvas.line({{area_.left, y}, {area_.right, y}}, grid, {});
        canvas.text({area_.left - tick_gap, y}, shortened(canvas, tick.text, name_room()), Anchor::end, text);
    }
    const auto& ticks = plot_.x.ticks();
    for (const auto& tick : ticks) {
        const double x = x_at(tick.place);
        canvas.line({{x, area_.top}, {x, area_.bottom}}, grid, {});
        const auto words = data_.x.names.empty()
                               ? tick.text
                               : shortened(canvas, tick.text, area_.width() / double(ticks.size()));
        canvas.text({x, area_.bottom + tick_row * canvas.line_height()}, words, Anchor::middle, text);
    }
    canvas.line({{area_.left, area_.top}, {area_.left, area_.bottom}, {area_.right, area_.bottom}}, axis, {});
}

void PlotDrawing::draw_axis_titles(PlotCanvas& canvas) const {
    const PlotCanvas::Ink ink{style_.text, "text"};
    const double line = canvas.line_height();
    const auto x_title = shortened(canvas, data_.x.title, width_ - margin);
    const auto y_title = shortened(canvas, data_.y.title, height_ - margin);
    const Place below{kept_inside((area_.left + area_.right) / 2, canvas.width_of(x_title), width_),
                      area_.bottom + axis_title_row * line};
    const Place beside{tick_row * line,
                       kept_inside((area_.top + area_.bottom) / 2, canvas.width_of(y_title), height_)};
    canvas.text(below, x_title, Anchor::middle, ink);
    canvas.text(beside, y_title, Anchor::middle, ink, Letters::upwards);
}

void PlotDrawing::draw_legend(PlotCanvas& canvas) const {
    for (const auto& [words, series, at] : legend_) {
        if (series == rest_entry) {
            canvas.text(at, words, Anchor::start, {style_.dim, "dim"});
            continue;
        }
        const Place centre{at.x + sample_width / 2, at.y}, end{at.x + sample_width, at.y};
        if (data_.are_bars) {
            canvas.box({centre.x - swatch / 2, at.y - swatch / 2, centre.x + swatch / 2, at.y + swatch / 2},
                       {style_.series(series), "mark " + series_name(style_, series)});
        } else if (series == rings_entry) {
            if (data_.join_rings) canvas.line({at, end}, {style_.front, "front"}, front_stroke);
            draw_ring(canvas, centre, 6, style_, true);
        } else {
            canvas.line({at, end}, {style_.series(series), "line " + series_name(style_, series)},
                        series_stroke);
            draw_plot_mark(canvas, centre, series, ir::mark_radius(0), style_);
        }
        canvas.text({at.x + mark_room, at.y}, words, Anchor::start, {style_.text, "text"});
    }
}

/// The colours with the least and the greatest value, and what they stand for.
void PlotDrawing::draw_heat_legend(PlotCanvas& canvas) const {
    constexpr double width = 120, height = 12;
    constexpr int steps = 24;
    const auto& heat = *plot_.heat;
    const auto low = plot_number(heat.low), high = plot_number(heat.high);
    const double left = margin + canvas.width_of(low) + tick_gap, y = legend_.front().at.y;
    const PlotCanvas::Ink text{style_.text, "text"};
    canvas.text({margin, y}, low, Anchor::start, text);
    for (int i = 0; i < steps; ++i) {
        const double x = left + i * width / steps;
        canvas.box({x, y - height / 2, x + width / steps + 0.5, y + height / 2},
                   {heat.colour(heat.at((i + 0.5) / steps)), "heat"});
    }
    canvas.text({left + width + tick_gap, y}, high + "  " + legend_.front().words, Anchor::start, text);
}

void PlotDrawing::draw_tile(PlotCanvas& canvas, const Mark& mark) const {
    const auto tile = box(mark);
    canvas.begin_point(point(mark));
    canvas.box(tile, {plot_.heat->colour(mark.value), "tile"});
    if (tile.width() >= min_tile_width && tile.height() >= min_tile_height)
        canvas.text({(tile.left + tile.right) / 2, (tile.top + tile.bottom) / 2}, plot_number(mark.value),
                    Anchor::middle, {plot_.heat->ink(mark.value), "value"});
    canvas.end_point();
}

/// With a line where x is 0.
void PlotDrawing::draw_bars(PlotCanvas& canvas) const {
    for (const auto& mark : plot_.marks) {
        const auto& own = point(mark).colour;
        canvas.begin_point(point(mark));
        canvas.box(box(mark), own ? PlotCanvas::Ink{plot_colour(*own), "own"}
                                  : PlotCanvas::Ink{style_.series(mark.series),
                                                    "mark " + series_name(style_, mark.series)});
        canvas.end_point();
    }
    const double zero = plot_.x.place(0);
    if (zero > plot_.x.low() && zero < plot_.x.high())
        canvas.line({{x_at(zero), area_.top}, {x_at(zero), area_.bottom}}, {style_.dim, "axis"}, {});
}

void PlotDrawing::draw_level(PlotCanvas& canvas) const {
    if (!plot_.shows_level || plot_.marks.empty()) return;
    const double y = y_at(plot_.y.place(data_.level->y)), line = canvas.line_height();
    canvas.line({{area_.left, y}, {area_.right, y}}, {style_.level, "level"}, level_stroke);
    const bool is_above = y - line > area_.top;
    canvas.text({area_.right - tick_gap, y + (is_above ? -0.5 : 0.5) * line},
                shortened(canvas, data_.level->label, area_.width() - 2 * tick_gap), Anchor::end,
                {style_.dim, "dim"});
}

void PlotDrawing::draw_lines(PlotCanvas& canvas) const {
    std::vector<Place> line, front;
    for (std::size_t i = 0; i < plot_.marks.size(); ++i) {
        const auto& mark = plot_.marks[i];
        line.push_back(place(mark));
        if (mark.ring) front.push_back(place(mark));
        if (i + 1 < plot_.marks.size() && !plot_.marks[i + 1].begins) continue;
        if (line.size() > 1)
            canvas.line(line, {style_.series(mark.series), "line " + series_name(style_, mark.series)},
                        series_stroke);
        line.clear();
    }
    std::sort(front.begin(), front.end(), [](Place a, Place b) { return a.x < b.x; });
    if (data_.join_rings && front.size() > 1) canvas.line(front, {style_.front, "front"}, front_stroke);
}

void PlotDrawing::draw_mark(PlotCanvas& canvas, const Mark& mark, double growth) const {
    const double radius = mark_radius() + growth;
    draw_plot_mark(canvas, place(mark), mark.series, radius, style_, mark.displaced);
    if (mark.ring) draw_ring(canvas, place(mark), radius + 3, style_, false);
}

}  // namespace ir
