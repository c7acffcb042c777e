#pragma once

#include <QPoint>
#include <Qt>

namespace ir::widgets {

/// One step to where an arrow key points, y down; none of other keys.
inline QPoint arrow_of(int key) {
    switch (key) {
        case Qt::Key_Left:
            return {-1, 0};
        case Qt::Key_Right:
            return {1, 0};
        case Qt::Key_Up:
            return {0, -1};
        case Qt::Key_Down:
            return {0, 1};
        default:
            return {};
    }
}

}  // namespace ir::widgets
