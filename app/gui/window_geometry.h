#pragma once

#include <QRect>

namespace ir::gui {

/// A window's geometry, without its frame, moved and shrunk into what the screen has for windows; above it
/// stands a title bar of that height.
QRect within(QRect window, const QRect& available, int title_bar);

}  // namespace ir::gui
