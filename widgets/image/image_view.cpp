#include "widgets/image/image_view.h"

#include <QGuiApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace ir::widgets {
namespace {

/// A drag across the whole height of the view turns the camera by half a circle.
constexpr double radians_per_view = std::numbers::pi;
constexpr double zoom_step = 1.25;
/// A camera that was moved by wheel or keys is left alone after so long.
constexpr int settle_ms = 350;
/// Logical pixels on either side of the divider that take hold of it.
constexpr double divider_reach = 7;

bool is_fly_key(int key) {
    return key == Qt::Key_W || key == Qt::Key_A || key == Qt::Key_S || key == Qt::Key_D || key == Qt::Key_Q ||
           key == Qt::Key_E;
}

}  // namespace

ImageView::ImageView(QWidget* parent, Surface surface) : QWidget(parent) {
    canvas_ = surface == Surface::raster ? make_raster_canvas(state_, this) : make_canvas(state_, this);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(canvas_->widget());
    overlay_ = make_overlay(state_, this);
    overlay_->raise();
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(64, 48);  // four side-by-side pairs fit a small screen
    setAccessibleName(tr("Picture"));
    fly_timer_.setInterval(16);
    settle_timer_.setInterval(settle_ms);
    settle_timer_.setSingleShot(true);
    connect(&fly_timer_, &QTimer::timeout, this, &ImageView::fly_step);
    connect(&settle_timer_, &QTimer::timeout, this, &ImageView::finish_gesture);
    update_cursor_shape();
}

void ImageView::repaint_all() {
    canvas_->state_changed();
    overlay_->update();
}

void ImageView::set_tool(Tool tool) {
    if (tool == tool_) return;
    finish_gesture();
    tool_ = tool;
    update_hint();
    update_cursor_shape();
    emit tool_changed(tool);
}

void ImageView::update_hint() {
    state_.hint = tool_ == Tool::orbit
                      ? tr("Orbit: drag to turn  ·  Shift-drag to slide  ·  Ctrl+wheel for distance")
                  : tool_ == Tool::fly
                      ? tr("Fly: drag to look  ·  W A S D to move, Q E down and up  ·  Shift is faster")
                  : tool_ == Tool::rectangle
                      ? tr("Rectangle: drag to draw, move or resize  ·  arrows nudge  ·  Esc clears")
                      : QString();
    state_.region_edited = tool_ == Tool::rectangle;
    repaint_all();
}

void ImageView::update_cursor_shape() {
    if (drag_ == Drag::wipe || (drag_ == Drag::none && !space_ && over_divider_))
        setCursor(Qt::SplitHCursor);
    else if (drag_ == Drag::pan || space_)
        setCursor(drag_ == Drag::pan ? Qt::ClosedHandCursor : Qt::OpenHandCursor);
    else if (tool_ == Tool::rectangle)
        setCursor(region_cursor(region_grip_));
    else
        setCursor(tool_ == Tool::inspect ? Qt::CrossCursor : Qt::SizeAllCursor);
}

void ImageView::finish_transform() {
    repaint_all();
    emit zoom_changed(state_.transform.zoom());
    emit transform_changed(state_.transform);
}

void ImageView::fit() {
    state_.transform.fit();
    finish_transform();
}

void ImageView::actual_pixels() {
    look_at(state_.transform.centre(), 1);
}

void ImageView::look_at(QPointF image_px, double zoom) {
    state_.transform.look_at(image_px, zoom);
    finish_transform();
}

void ImageView::zoom_in() {
    look_at(state_.transform.centre(), state_.transform.zoom() * zoom_step);
}

void ImageView::zoom_out() {
    look_at(state_.transform.centre(), state_.transform.zoom() / zoom_step);
}

void ImageView::set_pixel_grid(bool on) {
    state_.pixel_grid = on;
    repaint_all();
}

QPoint ImageView::pixel_at(QPointF logical) const {
    const QPointF at = state_.transform.image_from_view(device(logical));
    const QPoint pixel(int(std::floor(at.x())), int(std::floor(at.y())));
    const QRect picture(QPoint(0, 0), state_.transform.image_size().toSize());
    return state_.has_image() && picture.contains(pixel) ? pixel : QPoint(-1, -1);
}

void ImageView::resizeEvent(QResizeEvent*) {
    overlay_->setGeometry(rect());
    state_.transform.set_view_size(QSizeF(size()) * devicePixelRatioF());
    repaint_all();
    emit zoom_changed(state_.transform.zoom());
}

void ImageView::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::ParentChange || event->type() == QEvent::ScreenChangeInternal)
        state_.transform.set_view_size(QSizeF(size()) * devicePixelRatioF());
}

ImageView::Drag ImageView::drag_for(const QMouseEvent& event) const {
    if (event.button() == Qt::MiddleButton || (event.button() == Qt::LeftButton && space_)) return Drag::pan;
    if (event.button() == Qt::LeftButton && is_over_divider(event.position())) return Drag::wipe;
    if (tool_ == Tool::rectangle && event.button() == Qt::LeftButton)
        return state_.has_image() ? Drag::region : Drag::pan;
    if (tool_ == Tool::inspect || tool_ == Tool::rectangle)
        return event.button() == Qt::LeftButton    ? Drag::pick
               : event.button() == Qt::RightButton ? Drag::pan
                                                   : Drag::none;
    if (event.button() == Qt::RightButton || event.modifiers() & Qt::ShiftModifier) return Drag::slide;
    return tool_ == Tool::orbit ? Drag::orbit : Drag::look;
}

void ImageView::mousePressEvent(QMouseEvent* event) {
    if (drag_ != Drag::none) return;
    drag_ = drag_for(*event);
    last_position_ = press_position_ = event->position();
    if (drag_ == Drag::region) start_region(event->position());
    update_cursor_shape();
}

void ImageView::mouseMoveEvent(QMouseEvent* event) {
    const QPointF delta = event->position() - last_position_;
    last_position_ = event->position();
    // A press that wanders off is no pick but a pan.
    if (drag_ == Drag::pick && (event->position() - press_position_).manhattanLength() > 4) drag_ = Drag::pan;
    if (drag_ == Drag::wipe) {
        const QPointF at = state_.transform.image_from_view(device(event->position()));
        move_wipe(at.x() / state_.transform.image_size().width());
    } else if (drag_ == Drag::pan) {
        state_.transform.pan(device(delta));
        finish_transform();
    } else if (drag_ == Drag::region) {
        drag_region(event->position(), event->modifiers());
    } else if (drag_ == Drag::orbit || drag_ == Drag::slide || drag_ == Drag::look) {
        drag_camera(delta);
    }
    const bool over = is_over_divider(event->position());
    if (over != over_divider_) {
        over_divider_ = over;
        update_cursor_shape();
    }
    if (drag_ == Drag::none && tool_ == Tool::rectangle) {
        region_grip_ = region_grip_at(event->position());
        update_cursor_shape();
    }
    emit cursor_moved(pixel_at(event->position()));
}

bool ImageView::event(QEvent* event) {
    // Escape clears the rectangle before it is the window's key.
    if (event->type() == QEvent::ShortcutOverride && takes_region_key(*static_cast<QKeyEvent*>(event))) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

bool ImageView::is_over_divider(QPointF logical) const {
    if (!state_.has_divider()) return false;
    const double y = device(logical).y(), top = state_.transform.offset().y();
    const double bottom = top + state_.transform.image_size().height() * state_.transform.zoom();
    const double reach = divider_reach * devicePixelRatioF();
    return y >= top && y < bottom && std::abs(device(logical).x() - state_.divider_x()) <= reach;
}

void ImageView::move_wipe(double fraction) {
    const double before = state_.wipe;
    set_wipe(fraction);
    if (state_.wipe != before) emit wipe_moved(state_.wipe);
}

void ImageView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton && is_over_divider(event->position())) return move_wipe(0.5);
    mousePressEvent(event);
}

void ImageView::drag_camera(QPointF delta) {
    const double turn = radians_per_view / std::max(1, height());
    if (drag_ == Drag::orbit) move_camera(orbited(pose_, -delta.x() * turn, delta.y() * turn));
    if (drag_ == Drag::look) move_camera(looked(pose_, -delta.x() * turn / 2, -delta.y() * turn / 2));
    if (drag_ == Drag::slide) {
        const double shown =
            state_.transform.image_size().height() * state_.transform.zoom() / devicePixelRatioF();
        const double scale = 1 / std::max(1.0, shown);
        move_camera(slid(pose_, -delta.x() * scale, delta.y() * scale));
    }
}

void ImageView::mouseReleaseEvent(QMouseEvent* event) {
    if (drag_ == Drag::pick) {
        state_.picked = pixel_at(event->position());
        repaint_all();
        emit picked_changed(state_.picked);
    }
    const bool moved_camera = drag_ == Drag::orbit || drag_ == Drag::slide || drag_ == Drag::look;
    drag_ = Drag::none;
    if (moved_camera) finish_gesture();
    update_cursor_shape();
}

void ImageView::wheelEvent(QWheelEvent* event) {
    const double steps = event->angleDelta().y() / 120.0;
    if (steps == 0) return;
    const bool moves_camera = tool_ == Tool::orbit || tool_ == Tool::fly;
    if (event->modifiers() & Qt::ControlModifier && moves_camera) {
        move_camera(dollied(pose_, std::pow(1.1, -steps)));
        settle_timer_.start();
    } else {
        state_.transform.zoom_about(device(event->position()),
                                    state_.transform.zoom() * std::pow(zoom_step, steps));
        finish_transform();
        emit cursor_moved(pixel_at(event->position()));
    }
    event->accept();
}

void ImageView::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Space) {
        space_ = true;
        return update_cursor_shape();
    }
    if (tool_ == Tool::fly && is_fly_key(event->key()) && !(event->modifiers() & Qt::ControlModifier)) {
        if (!event->isAutoRepeat()) keys_.insert(event->key());
        if (!fly_timer_.isActive()) {
            fly_clock_.start();
            fly_timer_.start();
        }
        return;
    }
    if (takes_region_key(*event)) return press_region_key(*event);
    const bool sideways = event->key() == Qt::Key_Left || event->key() == Qt::Key_Right;
    if (state_.has_divider() && sideways) {
        const double step = event->modifiers() & Qt::ShiftModifier ? 0.1 : 0.01;
        return move_wipe(state_.wipe + (event->key() == Qt::Key_Left ? -step : step));
    }
    QWidget::keyPressEvent(event);
}

void ImageView::keyReleaseEvent(QKeyEvent* event) {
    if (event->isAutoRepeat()) return;
    if (event->key() == Qt::Key_Space) {
        space_ = false;
        update_cursor_shape();
    }
    if (!keys_.contains(event->key())) return QWidget::keyReleaseEvent(event);
    fly_step();  // a tap shorter than the timer's beat moves, too
    keys_.remove(event->key());
    if (!keys_.isEmpty()) return;
    fly_timer_.stop();
    settle_timer_.start();
}

void ImageView::fly_step() {
    const double seconds = std::clamp(fly_clock_.restart() / 1000.0, 0.004, 0.1);
    const bool fast = QGuiApplication::keyboardModifiers() & Qt::ShiftModifier;
    const double step = fly_speed_ * seconds * (fast ? 4 : 1);
    const auto axis = [&](int plus, int minus) {
        return step * ((keys_.contains(plus) ? 1 : 0) - (keys_.contains(minus) ? 1 : 0));
    };
    move_camera(
        flown(pose_, axis(Qt::Key_D, Qt::Key_A), axis(Qt::Key_E, Qt::Key_Q), axis(Qt::Key_W, Qt::Key_S)));
}

void ImageView::move_camera(const CameraPose& pose) {
    if (pose == pose_) return;
    pose_ = pose;
    gesture_ = true;
    emit camera_moved(pose_);
}

void ImageView::finish_gesture() {
    settle_timer_.stop();
    if (!gesture_) return;
    gesture_ = false;
    emit camera_gesture_finished();
}

void ImageView::leaveEvent(QEvent*) {
    emit cursor_moved({-1, -1});
}

void ImageView::focusInEvent(QFocusEvent* event) {
    QWidget::focusInEvent(event);
    emit activated();
}

void ImageView::focusOutEvent(QFocusEvent* event) {
    QWidget::focusOutEvent(event);
    keys_.clear();
    fly_timer_.stop();
    space_ = false;
    update_cursor_shape();
    if (drag_ == Drag::none) finish_gesture();
}

}  // namespace ir::widgets
