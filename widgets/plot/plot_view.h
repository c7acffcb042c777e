#pragma once

#include <QWidget>

#include "widgets/plot/plot_chart.h"

namespace ir::widgets {

/// A plot on the screen: tells which point lies under the cursor, is clicked, or walked to by keys.
class PlotView : public QWidget {
    Q_OBJECT
  public:
    explicit PlotView(QWidget* parent = nullptr);
    /// What was selected stays so, where it still is. Emits nothing.
    void set_data(const PlotData& data);
    const PlotData& data() const { return chart_.data(); }
    const PlotChart& plot() const { return chart_; }
    /// Emits nothing.
    void select(const QString& id);
    QString selected() const { return chart_.selected(); }
    /// Where a point is drawn.
    QPointF position_of(const QString& id) const;
    /// The point whose mark is under the place, or nearly; empty: none.
    QString point_at(const QPointF& place) const;

  signals:
    void selected_changed(const QString& id);
    /// Clicked, or chosen with Enter.
    void activated(const QString& id);

  protected:
    void mousePressEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    void choose(const QString& id);
    QString neighbour(int steps) const;
    QString in_other_series(int steps) const;

    PlotChart chart_;
    QString pressed_;
};

}  // namespace ir::widgets
