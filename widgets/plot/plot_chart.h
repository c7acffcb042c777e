#pragma once

#include <QCoreApplication>
#include <QFont>
#include <QImage>
#include <QPen>
#include <vector>

#include "renderers/plot/placed_plot.h"
#include "widgets/plot/plot_marks.h"

class QPainter;

namespace ir::widgets {

/// A plot with title, legend and axes as a size takes them, to be painted on a widget or into a picture.
class PlotChart {
    Q_DECLARE_TR_FUNCTIONS(PlotChart)
  public:
    using Mark = PlacedPlot::Mark;

    explicit PlotChart(const PlotStyle& style);
    void set_data(const PlotData& data);
    void set_colours(const PlotStyle& style) { style_ = style; }
    void set_size(const QSizeF& size);
    const PlotData& data() const { return data_; }
    /// Points that have a place, in the order of series, then points.
    const std::vector<Mark>& marks() const { return placed_.marks; }
    const Mark* mark(const QString& id) const;
    QPointF position(const Mark& mark) const;
    /// Whether a place lies in a heat map's tile.
    bool is_in_tile(const Mark& mark, const QPointF& place) const;
    bool is_heat() const { return placed_.heat.has_value(); }
    /// Points whose values the axes cannot show, and levels that lie far from all points: a line each.
    const std::vector<std::string>& remarks() const { return placed_.remarks; }
    void set_selected(const QString& id) { selected_ = id; }
    /// Whether it was another one.
    bool set_hovered(const QString& id);
    const QString& selected() const { return selected_; }

    /// Between the axes.
    const QRectF& plot_area() const { return area_; }
    /// Where the titles of both axes stand.
    QRectF x_title() const;
    QRectF y_title() const;

    void paint(QPainter& painter) const;

  private:
    struct Entry {
        QString text;
        int series;  ///< or what else it names
        QPointF at;
    };
    using Points = std::vector<QPointF>;
    void rebuild();
    double lay_out_legend();
    void paint_axes(QPainter& painter) const;
    void paint_lines(QPainter& painter) const;
    void paint_header(QPainter& painter) const;
    void paint_level(QPainter& painter) const;
    void paint_points(QPainter& painter) const;
    void paint_heat_legend(QPainter& painter) const;
    void paint_tiles(QPainter& painter) const;
    QRectF tile(const Mark& mark) const;
    double x_at(double place) const;
    double y_at(double place) const;

    PlotStyle style_;
    QSizeF size_;
    PlotData data_;
    PlacedPlot placed_;
    std::vector<Entry> legend_;
    QRectF area_;
    QString selected_, hovered_;
    QFont font_, title_font_;
};

/// The plot with title, axes and legend, size · scale pixels large.
QImage plot_picture(const PlotData& data, const QSize& size, double scale, const PlotStyle& style);

}  // namespace ir::widgets
