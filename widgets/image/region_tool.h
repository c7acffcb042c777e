#pragma once

#include "widgets/image/region.h"
#include "widgets/image/shape_tool.h"

namespace ir::widgets {

/// Draws the rectangle of a view.
class RegionTool : public ShapeTool {
    Q_OBJECT
  public:
    using ShapeTool::ShapeTool;

    void hover(QPointF position) override;
    Qt::CursorShape cursor() const override;
    bool takes(const QKeyEvent& event) const override;

  signals:
    void changed(const QRect& region);

  protected:
    void begin() override { before_ = state_.marks.region; }
    void move_to(QPointF pixel, bool constrain) override;
    void clear() override { change({}); }
    void take_back() override { change(before_); }
    void nudge(QPoint step, bool resize) override;
    bool holds() const override { return !grip_.none(); }
    bool drew() const override { return state_.marks.region != before_; }

  private:
    bool is_active() const { return state_.region_edited && state_.has_image(); }
    void change(const QRect& region);

    RegionGrip grip_;  ///< under the cursor; of the drag while there is one
    QRect before_;     ///< when the drag, or the key's move, began
};

}  // namespace ir::widgets
