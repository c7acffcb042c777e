#pragma once

#include <QPoint>
#include <QRect>
#include <QSize>

#include "widgets/image/view_transform.h"

namespace ir::widgets {

/// What a press takes hold of: the inside of a rectangle, an edge or a corner.
struct RegionGrip {
    int x = 0, y = 0;  ///< -1 left or top edge, 1 right or bottom edge
    bool inside = false;
    bool none() const { return x == 0 && y == 0 && !inside; }
    bool operator==(const RegionGrip&) const = default;
};

/// Rectangles are in whole pixels of the picture, empty where there is none. `reach` is in device pixels; an
/// edge is taken hold of from outside, too.
RegionGrip grip_at(const QRect& region, const ViewTransform& transform, QPointF view_px, double reach);

/// All pixels between two points of the picture, clipped to it; `square`: as wide as high, from `from` on.
/// Empty where none of them belongs to the picture.
QRect drawn_region(QPointF from_px, QPointF to_px, bool square, QSize picture);

/// A rectangle after its grip was dragged by `delta_px`. Moving keeps the size and stays in the picture; an
/// edge leaves at least one pixel. `constrain`: moves along one axis; corners keep the proportions.
QRect dragged_region(const QRect& region, RegionGrip grip, QPointF delta_px, bool constrain, QSize picture);

/// Moves by whole pixels, as far as the picture goes.
QRect nudged_region(const QRect& region, QPoint by, QSize picture);
/// Moves the lower right corner by whole pixels, as far as the picture goes.
QRect grown_region(const QRect& region, QPoint by, QSize picture);

}  // namespace ir::widgets
