#pragma once

namespace ir::gui {

/// Milliseconds between two drawings of what may come quicker than it can be drawn.
inline constexpr int redraw_ms = 60;

}  // namespace ir::gui
