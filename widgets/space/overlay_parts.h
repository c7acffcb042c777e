#pragma once

#include "widgets/space/space_overlay.h"

/// What the parts of the overlay have in common. Lengths are logical pixels.
namespace ir::widgets::overlay {

inline constexpr QColor badge_colour{20, 20, 20, 200}, text_colour{235, 235, 235},
    dim_text_colour{175, 175, 175}, warning_colour{232, 179, 74};
inline constexpr double gap = 10, padding = 8;

QFont small_font(const QPainter& painter, int pixels = 12, bool bold = false);
void paint_box(QPainter& painter, const QRectF& box);
/// In the top right corner: for each layer its label, what its colours mean, how many of its elements are
/// drawn, and why not as asked. In small views lines at the top; returns how high these are.
double paint_legends(QPainter& painter, const OverlayState& state, const QRectF& area);

}  // namespace ir::widgets::overlay
