#pragma once

#include <QObject>
#include <QWidget>

#include "widgets/image/canvas.h"
#include "widgets/image/region.h"

class QKeyEvent;

namespace ir::widgets {

/// Draws, moves and resizes the rectangle of a view by hand, with the mouse and the arrow keys. Positions are
/// logical pixels of the view.
class RegionTool : public QObject {
    Q_OBJECT
  public:
    /// Reads the rectangle there; both outlive this.
    RegionTool(const CanvasState& state, QWidget& view) : state_(state), view_(view) {}

    void hover(QPointF position);
    void press(QPointF position);
    /// Shift keeps a direction or proportions.
    void drag(QPointF position, Qt::KeyboardModifiers modifiers);
    void release() { dragging_ = false; }
    Qt::CursorShape cursor() const;

    /// Escape and Delete clear (or take a drag back), arrows move, with Shift resize.
    bool takes(const QKeyEvent& event) const;
    void press_key(const QKeyEvent& event);

  signals:
    void changed(const QRect& region);

  private:
    bool is_active() const { return state_.region_edited && state_.has_image(); }
    QPointF pixel_at(QPointF position) const;
    QSize picture_size() const { return state_.transform.image_size().toSize(); }
    void change(const QRect& region);

    const CanvasState& state_;
    QWidget& view_;
    RegionGrip grip_;  ///< under the cursor; of the drag while there is one
    bool dragging_ = false;
    QRect before_;            ///< when the drag began
    QPointF from_, pressed_;  ///< where it began, pixels of the picture and of the view
};

}  // namespace ir::widgets
