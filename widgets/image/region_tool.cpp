#include "widgets/image/region_tool.h"

#include <QKeyEvent>

#include "widgets/image/arrow_keys.h"

namespace ir::widgets {
namespace {

/// Logical pixels within which an edge is taken hold of.
constexpr double edge_reach = 6;

}  // namespace

QPointF RegionTool::pixel_at(QPointF position) const {
    return state_.transform.image_from_view(position * view_.devicePixelRatioF());
}

void RegionTool::change(const QRect& region) {
    if (region != state_.marks.region) emit changed(region);
}

void RegionTool::hover(QPointF position) {
    const qreal ratio = view_.devicePixelRatioF();
    grip_ = is_active() ? grip_at(state_.marks.region, state_.transform, position * ratio, edge_reach * ratio)
                        : RegionGrip();
}

void RegionTool::press(QPointF position) {
    hover(position);
    dragging_ = true;
    before_ = state_.marks.region;
    pressed_ = position;
    from_ = pixel_at(position);
}

void RegionTool::drag(QPointF position, Qt::KeyboardModifiers modifiers) {
    if (!dragging_) return;
    const bool constrain = modifiers & Qt::ShiftModifier;
    if (!grip_.none())
        return change(dragged_region(before_, grip_, pixel_at(position) - from_, constrain, picture_size()));
    // A press that hardly moves is no rectangle.
    if ((position - pressed_).manhattanLength() < 3 && state_.marks.region == before_) return;
    change(drawn_region(from_, pixel_at(position), constrain, picture_size()));
}

bool RegionTool::takes(const QKeyEvent& event) const {
    if (!is_active() || (state_.marks.region.isEmpty() && !dragging_)) return false;
    const auto modifiers = event.modifiers() & ~Qt::KeyboardModifiers(Qt::KeypadModifier);
    if (event.key() == Qt::Key_Escape || event.key() == Qt::Key_Delete) return modifiers == Qt::NoModifier;
    return !arrow_of(event.key()).isNull() && (modifiers == Qt::NoModifier || modifiers == Qt::ShiftModifier);
}

void RegionTool::press_key(const QKeyEvent& event) {
    const QPoint step = arrow_of(event.key());
    if (step.isNull()) return change(std::exchange(dragging_, false) ? before_ : QRect());
    change(event.modifiers() & Qt::ShiftModifier ? grown_region(state_.marks.region, step, picture_size())
                                                 : nudged_region(state_.marks.region, step, picture_size()));
}

Qt::CursorShape RegionTool::cursor() const {
    if (grip_.inside) return Qt::SizeAllCursor;
    if (grip_.none()) return Qt::CrossCursor;
    if (grip_.x == 0) return Qt::SizeVerCursor;
    if (grip_.y == 0) return Qt::SizeHorCursor;
    return grip_.x == grip_.y ? Qt::SizeFDiagCursor : Qt::SizeBDiagCursor;
}

}  // namespace ir::widgets
