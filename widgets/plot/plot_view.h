#pragma once

#include <QWidget>
#include <optional>

#include "renderers/plot/plot_drawing.h"

namespace ir::widgets {

/// A plot on the screen, as high as rows of bars need: tells which point lies under the cursor, is clicked,
/// or walked to by keys.
class PlotView : public QWidget {
    Q_OBJECT
  public:
    explicit PlotView(QWidget* parent = nullptr);
    /// What was selected stays so, where it still is. Emits nothing.
    void set_data(const PlotData& data);
    const PlotData& data() const { return data_; }
    /// Where its parts are, in the widget's coordinates.
    const PlotDrawing& drawing() const { return *drawing_; }
    /// Points that have a place, in the order of series, then points.
    const std::vector<PlotDrawing::Mark>& marks() const { return drawing_->plot().marks; }
    /// Emits nothing.
    void select(const QString& id);
    const QString& selected() const { return selected_; }
    /// Where a point is drawn.
    QPointF position_of(const QString& id) const;
    /// The point whose mark is under the place, or nearly; empty: none.
    QString point_at(const QPointF& place) const;
    static constexpr QSize min_size{220, 180};  ///< title, a line of the legend, both axes

  signals:
    void selected_changed(const QString& id);
    /// Clicked, or chosen with Enter.
    void activated(const QString& id);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    using Mark = PlotDrawing::Mark;
    void lay_out();
    void fit_rows();
    const Mark* mark(const QString& id) const;
    void show_selected(const QString& id);
    void hover(const QString& id);
    void choose(const QString& id);
    QString neighbour(int steps) const;
    QString in_other_series(int steps) const;
    void paint_chosen_boxes(QPainter& painter) const;
    void paint_chosen_points(PlotCanvas& canvas) const;

    PlotData data_;
    std::optional<PlotDrawing> drawing_;  ///< of data_; never empty
    QString selected_, hovered_, pressed_;
};

}  // namespace ir::widgets
