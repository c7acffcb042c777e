#pragma once

#include <QPainter>

#include "widgets/image/canvas.h"

namespace ir::widgets {

/// The rectangle that is measured: a line that shows on every colour and tints none; with handles and its
/// size while it is being edited.
void paint_region(QPainter& painter, const CanvasState& state, qreal pixel_ratio);

}  // namespace ir::widgets
