#pragma once

#include <QObject>
#include <QWidget>

#include "widgets/image/canvas.h"

class QKeyEvent;

namespace ir::widgets {

/// Moves and turns the light of a view by hand, with its handles and the arrow keys. Positions are logical
/// pixels of the view.
class LightTool : public QObject {
    Q_OBJECT
  public:
    /// Shows in `state` what the cursor is over; both outlive this.
    LightTool(CanvasState& state, QWidget& view) : state_(state), view_(view) {}

    /// Whether the handle under the cursor is another one than before.
    bool hover(QPointF position);
    bool is_over_handle() const { return state_.light_handle != LightHandle::none; }
    bool is_dragging() const { return dragging_; }
    void press(QPointF position);
    void drag(QPointF position);
    void release();
    /// How the handle under the cursor is used, or why there is none in sight; else empty.
    QString hint() const;

    /// Escape takes a drag back. Arrows move parallel to the picture, with Ctrl up and down nearer and
    /// farther, with Shift ten times as far; with Alt they turn.
    bool takes(const QKeyEvent& event) const;
    void press_key(const QKeyEvent& event);
    /// The gesture ends with the key, or where the keyboard goes elsewhere.
    void finish_keys();

  signals:
    void moved(const glm::dvec3& position);
    void turned(const glm::dvec3& direction);
    /// What came since the last one is one step; `kept` false: it was taken back.
    void finished(bool kept);

  private:
    bool is_active() const { return state_.light && state_.has_image(); }
    double length() const;
    void move_to(const glm::dvec3& position, const glm::dvec3& from);
    void turn_to(const glm::dvec3& direction);

    CanvasState& state_;
    QWidget& view_;
    LightDrag drag_;
    QPointF offset_;  ///< from the cursor to the end of the handle that it holds, device pixels
    bool dragging_ = false, nudging_ = false;
};

/// Metres that a handle is long, so that it is as long on the screen wherever the light stands.
double handle_length(const CanvasState& state, qreal pixel_ratio);
/// Where a point of the scene is seen in the view, device pixels; none: not in front of the camera.
std::optional<QPointF> seen_at(const CanvasState& state, const glm::dvec3& point);

/// Where a handle of the light is seen and held, device pixels.
struct Grip {
    QPointF centre, end;  ///< a line, of the centre a point
    double ring = 0;      ///< radius of a ring about the centre that takes the line's place; 0: there is none
    double distance_to(QPointF position) const;
};
/// A direction that points at the camera or away from it is a ring. None: out of sight, or an axis that does.
std::optional<Grip> grip_of(const CanvasState& state, LightHandle handle, qreal pixel_ratio);
void paint_light(QPainter& painter, const CanvasState& state, qreal pixel_ratio);

}  // namespace ir::widgets
