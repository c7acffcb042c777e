#pragma once

#include "widgets/image/image_view.h"

namespace ir::widgets {

/// How the tool of a view is used, where that is to be told: a small view, in logical pixels, has no room.
/// Empty: it is not, or the tool explains itself.
QString tool_hint(ImageView::Tool tool, const CanvasState& state, QSize view);

}  // namespace ir::widgets
