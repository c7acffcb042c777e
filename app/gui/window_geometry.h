#pragma once

#include <QRect>
#include <QSize>

namespace ir::gui {

/// A screen of 1280×800 without its title bar: there the panels of both sides fit beside four views.
inline constexpr QSize min_size_for_all_panels(1280, 770);

/// A window's geometry, without its frame, moved and shrunk into what the screen has for windows; above it
/// stands a title bar of that height.
QRect within(QRect window, const QRect& available, int title_bar);

}  // namespace ir::gui
