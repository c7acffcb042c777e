#include "app/gui/window_geometry.h"

#include <algorithm>

namespace ir::gui {

QRect within(QRect window, const QRect& available, int title_bar) {
    const QRect room = available.adjusted(0, title_bar, 0, 0);
    window.setSize(window.size().boundedTo(room.size()));
    window.moveLeft(std::clamp(window.left(), room.left(), room.right() + 1 - window.width()));
    window.moveTop(std::clamp(window.top(), room.top(), room.bottom() + 1 - window.height()));
    return window;
}

}  // namespace ir::gui
