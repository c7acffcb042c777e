#include <QKeyEvent>
#include <QMouseEvent>

#include "widgets/image/image_view.h"

/// The rectangle of an ImageView: drawn, moved and resized with its own tool.
namespace ir::widgets {
namespace {

/// Logical pixels within which an edge is taken hold of.
constexpr double edge_reach = 6;

QPoint step_of(int key) {
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

}  // namespace

void ImageView::set_region(const QRect& region) {
    if (region == state_.region) return;
    state_.region = region;
    overlay_->update();
}

void ImageView::change_region(const QRect& region) {
    if (region == state_.region) return;
    set_region(region);
    emit region_changed(region);
}

bool ImageView::edits_region() const {
    return tool_ == Tool::rectangle && state_.has_image();
}

RegionGrip ImageView::region_grip_at(QPointF logical) const {
    if (!edits_region()) return {};
    return grip_at(state_.region, state_.transform, device(logical), edge_reach * devicePixelRatioF());
}

void ImageView::start_region(QPointF logical) {
    region_grip_ = region_grip_at(logical);
    region_before_ = state_.region;
    region_from_ = state_.transform.image_from_view(device(logical));
}

void ImageView::drag_region(QPointF logical, Qt::KeyboardModifiers modifiers) {
    const QPointF at = state_.transform.image_from_view(device(logical));
    const QSize picture = state_.transform.image_size().toSize();
    const bool constrain = modifiers & Qt::ShiftModifier;
    if (!region_grip_.none())
        return change_region(
            dragged_region(region_before_, region_grip_, at - region_from_, constrain, picture));
    // A press that hardly moves is no rectangle.
    if ((logical - press_position_).manhattanLength() < 3 && state_.region == region_before_) return;
    change_region(drawn_region(region_from_, at, constrain, picture));
}

bool ImageView::takes_region_key(const QKeyEvent& event) const {
    if (!edits_region() || (state_.region.isEmpty() && drag_ != Drag::region)) return false;
    const auto modifiers = event.modifiers() & ~Qt::KeyboardModifiers(Qt::KeypadModifier);
    if (event.key() == Qt::Key_Escape || event.key() == Qt::Key_Delete) return modifiers == Qt::NoModifier;
    return !step_of(event.key()).isNull() && (modifiers == Qt::NoModifier || modifiers == Qt::ShiftModifier);
}

void ImageView::press_region_key(const QKeyEvent& event) {
    const QSize picture = state_.transform.image_size().toSize();
    const QPoint step = step_of(event.key());
    if (step.isNull()) {  // Escape and Delete; a drag under way is taken back instead
        const bool dragging = drag_ == Drag::region;
        drag_ = Drag::none;
        return change_region(dragging ? region_before_ : QRect());
    }
    change_region(event.modifiers() & Qt::ShiftModifier ? grown_region(state_.region, step, picture)
                                                        : nudged_region(state_.region, step, picture));
}

Qt::CursorShape ImageView::region_cursor(const RegionGrip& grip) {
    if (grip.inside) return Qt::SizeAllCursor;
    if (grip.none()) return Qt::CrossCursor;
    if (grip.x == 0) return Qt::SizeVerCursor;
    if (grip.y == 0) return Qt::SizeHorCursor;
    return grip.x == grip.y ? Qt::SizeFDiagCursor : Qt::SizeBDiagCursor;
}

}  // namespace ir::widgets
