#pragma once

#include <QLine>

#include "widgets/image/shape_tool.h"

namespace ir::widgets {

/// Draws the line of a view, from the middle of a pixel to that of another one. Shift keeps it horizontal,
/// vertical or diagonal. Without one an arrow draws a whole row or column through the picture's middle.
class LineTool : public ShapeTool {
    Q_OBJECT
  public:
    using ShapeTool::ShapeTool;

    void hover(QPointF position) override;
    Qt::CursorShape cursor() const override;
    bool takes(const QKeyEvent& event) const override;

  signals:
    void changed(const QLine& line);

  protected:
    void begin() override { before_ = state_.marks.line; }
    void move_to(QPointF pixel, bool constrain) override;
    void clear() override { change({}); }
    void take_back() override { change(before_); }
    void nudge(QPoint step, bool resize) override;
    bool holds() const override { return grip_ != Grip::none; }
    bool drew() const override { return state_.marks.line != before_; }

  private:
    enum class Grip { none, start, end, whole };
    bool is_active() const { return state_.line_edited && state_.has_image(); }
    void change(const QLine& line);

    Grip grip_ = Grip::none;  ///< under the cursor; of the drag while there is one
    QLine before_;            ///< when the drag, or the key's move, began
};

}  // namespace ir::widgets
