#pragma once

#include <QObject>
#include <QWidget>

#include "widgets/image/canvas.h"

class QKeyEvent;

namespace ir::widgets {

/// Draws, moves and resizes a shape of a view by hand, with the mouse and the arrow keys. Positions are
/// logical pixels of the view.
class ShapeTool : public QObject {
    Q_OBJECT
  public:
    /// Reads the shape there; both outlive this.
    ShapeTool(const CanvasState& state, QWidget& view) : state_(state), view_(view) {}

    virtual void hover(QPointF position) = 0;
    void press(QPointF position);
    /// Shift keeps a direction or proportions.
    void drag(QPointF position, Qt::KeyboardModifiers modifiers);
    void release();
    virtual Qt::CursorShape cursor() const = 0;

    /// Escape and Delete clear (or take a drag back), arrows move, with Shift resize.
    virtual bool takes(const QKeyEvent& event) const = 0;
    void press_key(const QKeyEvent& event);

  signals:
    void finished();  ///< the hand let go or a key was pressed, and the shape is another one

  protected:
    /// Remembers the shape, from the pixel where the drag begins.
    virtual void begin() = 0;
    virtual void move_to(QPointF pixel, bool constrain) = 0;
    virtual void clear() = 0;
    virtual void take_back() = 0;
    virtual void nudge(QPoint step, bool resize) = 0;
    /// A press that holds nothing and hardly moves draws nothing.
    virtual bool holds() const = 0;
    /// It is another one than begin() remembered.
    virtual bool drew() const = 0;

    QPointF pixel_at(QPointF position) const;
    QSize picture_size() const { return state_.transform.image_size().toSize(); }
    bool is_dragging() const { return dragging_; }
    QPointF from() const { return from_; }  ///< where the drag began, pixels of the picture
    qreal ratio() const { return view_.devicePixelRatioF(); }

    const CanvasState& state_;

  private:
    QWidget& view_;
    bool dragging_ = false;
    QPointF from_, pressed_;  ///< where it began, pixels of the picture and of the view
};

/// Whether a key clears, moves or resizes what is there.
bool is_shape_key(const QKeyEvent& event);

}  // namespace ir::widgets
