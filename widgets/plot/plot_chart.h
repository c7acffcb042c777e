#pragma once

#include <QChart>
#include <QImage>

#include "renderers/plot/placed_plot.h"
#include "widgets/plot/plot_marks.h"

class QCategoryAxis;

namespace ir::widgets {

/// A plot as an item of a scene: axes and lines by Qt Charts; marks, rings, the level, title and legend
/// painted by an item of its own, so that thousands of points stay quick.
class PlotChart : public QChart {
    Q_OBJECT
  public:
    using Mark = PlacedPlot::Mark;

    explicit PlotChart(const PlotStyle& style, QGraphicsItem* parent = nullptr);
    void set_data(const PlotData& data);
    const PlotData& data() const { return data_; }
    const PlotStyle& colours() const { return style_; }
    /// Points that have a place, in the order of series, then points.
    const std::vector<Mark>& marks() const { return placed_.marks; }
    const Mark* mark(const QString& id) const;
    /// In the chart's coordinates.
    QPointF position(const Mark& mark) const;
    /// Whether a place in the chart's coordinates lies in a heat map's tile.
    bool is_in_tile(const Mark& mark, const QPointF& place) const;
    bool is_heat() const { return placed_.heat.has_value(); }
    /// Points whose values the axes cannot show, and levels that lie far from all points: a line each.
    const std::vector<std::string>& remarks() const { return placed_.remarks; }
    void set_selected(const QString& id);
    void set_hovered(const QString& id);
    const QString& selected() const { return selected_; }

    /// Painted by the marks' item.
    void paint_marks(QPainter& painter) const;

  protected:
    void resizeEvent(QGraphicsSceneResizeEvent* event) override;

  private:
    struct Entry {
        QString text;
        int series;  ///< or what else it names
        QPointF at;
    };
    void rebuild();
    void lay_out_legend();
    void make_lines();
    QCategoryAxis* make_axis(Qt::Alignment side);
    void show_axis(QCategoryAxis& shown, const PlotScale& scale, const PlotAxis& axis);
    void add_line(const std::vector<QPointF>& points, const QPen& pen);
    void paint_header(QPainter& painter) const;
    void paint_level(QPainter& painter) const;
    void paint_points(QPainter& painter) const;
    void paint_heat_legend(QPainter& painter) const;
    void paint_tiles(QPainter& painter) const;
    QRectF tile(const Mark& mark) const;
    double y_at(double place) const;

    PlotStyle style_;
    PlotData data_;
    PlacedPlot placed_;
    std::vector<Entry> legend_;
    QString selected_, hovered_;
    QFont font_, title_font_;
    QGraphicsItem* painted_;
    QCategoryAxis *x_axis_ = nullptr, *y_axis_ = nullptr;
};

/// The plot with title, axes and legend, size · scale pixels large.
QImage plot_picture(const PlotData& data, const QSize& size, double scale, const PlotStyle& style);

}  // namespace ir::widgets
