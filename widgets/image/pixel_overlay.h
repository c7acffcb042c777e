#pragma once

#include <QPainter>

#include "widgets/image/canvas.h"

namespace ir::widgets {

/// Grid and numbers in zoomed pixels, where the zoom is large enough. Unit: a device pixel.
void paint_pixels(QPainter& painter, const CanvasState& state, qreal pixel_ratio);

}  // namespace ir::widgets
