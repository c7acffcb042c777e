#pragma once

#include "widgets/image/image_view.h"

namespace ir::widgets {

/// How a tool is used; empty: it explains itself.
QString tool_hint(ImageView::Tool tool);

/// The same where it is to be told in a view, in logical pixels: a small one has no room.
QString tool_hint(ImageView::Tool tool, const CanvasState& state, QSize view);

}  // namespace ir::widgets
