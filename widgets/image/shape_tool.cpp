#include "widgets/image/shape_tool.h"

#include <QKeyEvent>

#include "widgets/image/arrow_keys.h"

namespace ir::widgets {

QPointF ShapeTool::pixel_at(QPointF position) const {
    return state_.transform.image_from_view(position * ratio());
}

void ShapeTool::press(QPointF position) {
    hover(position);
    dragging_ = true;
    pressed_ = position;
    from_ = pixel_at(position);
    begin();
}

void ShapeTool::drag(QPointF position, Qt::KeyboardModifiers modifiers) {
    if (!dragging_) return;
    if (!holds() && !drew() && (position - pressed_).manhattanLength() < 3) return;
    move_to(pixel_at(position), modifiers & Qt::ShiftModifier);
}

void ShapeTool::release() {
    if (std::exchange(dragging_, false) && drew()) emit finished();
}

void ShapeTool::press_key(const QKeyEvent& event) {
    const QPoint step = arrow_of(event.key());
    if (!step.isNull()) {
        if (!dragging_) begin();
        nudge(step, event.modifiers() & Qt::ShiftModifier);
        if (!drew()) return;
    } else if (std::exchange(dragging_, false)) {
        take_back();
    } else {
        clear();
    }
    emit finished();
}

bool is_shape_key(const QKeyEvent& event) {
    const auto modifiers = event.modifiers() & ~Qt::KeyboardModifiers(Qt::KeypadModifier);
    if (event.key() == Qt::Key_Escape || event.key() == Qt::Key_Delete) return modifiers == Qt::NoModifier;
    return !arrow_of(event.key()).isNull() && (modifiers == Qt::NoModifier || modifiers == Qt::ShiftModifier);
}

}  // namespace ir::widgets
