#include "widgets/image/region_tool.h"

#include <QKeyEvent>

namespace ir::widgets {
namespace {

/// Logical pixels within which an edge is taken hold of.
constexpr double edge_reach = 6;

}  // namespace

void RegionTool::change(const QRect& region) {
    if (region != state_.marks.region) emit changed(region);
}

void RegionTool::hover(QPointF position) {
    grip_ = is_active()
                ? grip_at(state_.marks.region, state_.transform, position * ratio(), edge_reach * ratio())
                : RegionGrip();
}

void RegionTool::move_to(QPointF pixel, bool constrain) {
    change(grip_.none() ? drawn_region(from(), pixel, constrain, picture_size())
                        : dragged_region(before_, grip_, pixel - from(), constrain, picture_size()));
}

bool RegionTool::takes(const QKeyEvent& event) const {
    return is_active() && (!state_.marks.region.isEmpty() || is_dragging()) && is_shape_key(event);
}

void RegionTool::nudge(QPoint step, bool resize) {
    change(resize ? grown_region(state_.marks.region, step, picture_size())
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
