#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderers/plot/placed_plot.h"
#include "renderers/plot/plot_style.h"

namespace ir {

/// Draws parts of a plot, each upon those before: into a file, or on a screen. Lengths are logical pixels, y
/// goes downwards.
class PlotCanvas {
  public:
    struct Place {
        double x = 0, y = 0;
    };
    struct Box {
        double left = 0, top = 0, right = 0, bottom = 0;
        double width() const { return right - left; }
        double height() const { return bottom - top; }
        bool contains(Place at) const { return at.x >= left && at.x < right && at.y >= top && at.y < bottom; }
    };
    /// A colour, and the name by which a page may give another one to what has it.
    struct Ink {
        PlotColour colour;
        std::string name;
    };
    struct Stroke {
        double width = 1;
        std::vector<double> dashes = {};  ///< lengths drawn and left out in turn; empty: drawn throughout
        double opacity = 1;
    };
    /// A circle, or a polygon whose corners lie about its centre at distances of about `radius`.
    struct Shape {
        Place centre;
        double radius = 1;
        std::vector<std::pair<double, double>> corners = {};  ///< in units of the radius; empty: a circle
        PlotColour fill = {}, outline = {};                   ///< no fill: empty
        double outline_width = 1;
        std::string name = {};
    };
    enum class Anchor { start, middle, end };
    enum class Letters { plain, title, upwards };  ///< upwards: read from below

    virtual ~PlotCanvas() = default;
    /// From a line of text to the next.
    virtual double line_height() const = 0;
    virtual double width_of(const std::string& words, Letters letters = Letters::plain) const = 0;
    /// `at`: of the anchor, at half of the letters' height.
    virtual void text(Place at, const std::string& words, Anchor anchor, const Ink& ink,
                      Letters letters = Letters::plain) = 0;
    virtual void line(const std::vector<Place>& places, const Ink& ink, const Stroke& stroke) = 0;
    virtual void shape(const Shape& shape) = 0;
    virtual void box(const Box& box, const Ink& ink) = 0;
    /// What is drawn until end_point() belongs to this point.
    virtual void begin_point(const PlotPoint&) {}
    virtual void end_point() {}
};

/// A plot with title, legend and axes, laid out in a rectangle: where each part is, and drawn. The data and
/// the style outlive it.
class PlotDrawing {
  public:
    using Mark = PlacedPlot::Mark;

    /// `measure` tells how long texts are. `has_title`: whether the plot's title is drawn.
    PlotDrawing(const PlotData& data, const PlotStyle& style, double width, double height, bool has_title,
                const PlotCanvas& measure);
    const PlacedPlot& plot() const { return plot_; }
    /// What the axes enclose.
    const PlotCanvas::Box& area() const { return area_; }
    PlotCanvas::Place place(const Mark& mark) const { return {x_at(mark.x), y_at(mark.y)}; }
    /// Whether points are tiles of a heat map or bars: a box is drawn for each.
    bool has_boxes() const { return plot_.heat || data_.are_bars; }
    PlotCanvas::Box box(const Mark& mark) const;
    void draw(PlotCanvas& canvas) const;
    /// A point's mark with its ring, larger than among the others by that many pixels.
    void draw_mark(PlotCanvas& canvas, const Mark& mark, double growth = 0) const;
    double mark_radius() const { return ir::mark_radius(plot_.marks.size()); }
    /// The height at which each row of bars has room for its name; 0 where points are no bars.
    static double height_of_rows(const PlotData& data, double line_height);

  private:
    struct Entry {
        std::string words;
        int series;  ///< or what else it names
        PlotCanvas::Place at;
    };
    double x_at(double place) const;
    double y_at(double place) const;
    /// Where, in lines of text, what stands below the title begins.
    double first_line() const;
    void lay_out_legend(const PlotCanvas& measure);
    void draw_title(PlotCanvas& canvas) const;
    void draw_axes(PlotCanvas& canvas) const;
    void draw_axis_titles(PlotCanvas& canvas) const;
    void draw_legend(PlotCanvas& canvas) const;
    void draw_heat_legend(PlotCanvas& canvas) const;
    void draw_tile(PlotCanvas& canvas, const Mark& mark) const;
    void draw_bars(PlotCanvas& canvas) const;
    double name_room() const;
    void draw_level(PlotCanvas& canvas) const;
    void draw_lines(PlotCanvas& canvas) const;
    const PlotPoint& point(const Mark& mark) const {
        return data_.series[std::size_t(mark.series)].points[mark.point];
    }

    const PlotData& data_;
    const PlotStyle& style_;
    double width_, height_;
    std::vector<std::string> title_;  ///< lines; none: it is not drawn
    PlacedPlot plot_;
    PlotCanvas::Box area_;
    std::vector<Entry> legend_;
};

/// The mark of a series. Hollow ones stand at an end of an axis on which their value has no place.
void draw_plot_mark(PlotCanvas& canvas, PlotCanvas::Place centre, int series, double radius,
                    const PlotStyle& style, bool is_hollow = false);

}  // namespace ir
