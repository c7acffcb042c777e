#pragma once

#include <QWidget>

#include "widgets/timeline/timeline_state.h"

namespace ir::widgets {

/// Seconds from left to right, a line for each thing that moves with its name and its keys as marks, and the
/// time as a needle that is dragged. It snaps to frames. Left and Right step a frame, with Shift ten; Home
/// and End go to the ends; Space plays.
class TimeBar : public QWidget {
    Q_OBJECT
  public:
    explicit TimeBar(QWidget* parent = nullptr);
    /// Emits nothing.
    void show_state(const TimelineState& state);
    /// Where a time stands, logical pixels from the left, and back (snapped to frames, within the range).
    double position_of(double time) const;
    double time_at(double x) const;

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

  signals:
    void time_chosen(double time);
    void step_wanted(int frames);
    void play_toggled();

  protected:
    void paintEvent(QPaintEvent*) override;
    void mousePressEvent(QMouseEvent*) override;
    void mouseMoveEvent(QMouseEvent*) override;
    void keyPressEvent(QKeyEvent*) override;
    bool event(QEvent*) override;

  private:
    void paint_ruler(QPainter& painter) const;
    void paint_tracks(QPainter& painter) const;
    void paint_name(QPainter& painter, std::size_t track) const;
    void paint_needle(QPainter& painter) const;
    double line_of(std::size_t track) const;
    QString tip_at(const QPointF& place) const;

    TimelineState state_;
};

}  // namespace ir::widgets
