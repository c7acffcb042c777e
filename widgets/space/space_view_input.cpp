#include <QGuiApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QToolBar>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "widgets/space/picture_pacer.h"
#include "widgets/space/space_camera.h"
#include "widgets/space/space_view.h"

/// The hand's part of the 3D view: gestures and keys.
namespace ir::widgets {
namespace {

/// A drag across the whole height of the picture turns the camera by half a circle.
constexpr double radians_per_view = std::numbers::pi;
/// A press that moves further is a drag, not a click; logical pixels.
constexpr double click_reach = 4;
constexpr double wheel_step = 1.15;
/// Seconds to fly through the whole scene.
constexpr double crossing_seconds = 8;

bool is_fly_key(int key) {
    return key == Qt::Key_W || key == Qt::Key_A || key == Qt::Key_S || key == Qt::Key_D || key == Qt::Key_Q ||
           key == Qt::Key_E;
}

/// Keys that the view takes for itself, without Ctrl and Alt.
bool is_own_key(int key) {
    return is_fly_key(key) || key == Qt::Key_F || key == Qt::Key_Home;
}

}  // namespace

bool SpaceView::event(QEvent* event) {
    // The window may have shortcuts of one letter: where the camera flies they wait.
    if (event->type() == QEvent::ShortcutOverride) {
        const auto* key = static_cast<QKeyEvent*>(event);
        if (is_own_key(key->key()) && !(key->modifiers() & (Qt::ControlModifier | Qt::AltModifier))) {
            event->accept();
            return true;
        }
    }
    return QWidget::event(event);
}

void SpaceView::resizeEvent(QResizeEvent*) {
    // The layout places the picture after this event.
    QMetaObject::invokeMethod(
        this,
        [this] {
            overlay_widget_->setGeometry(picture_area());
            overlay_widget_->raise();
        },
        Qt::QueuedConnection);
    overlay_widget_->setGeometry(picture_area());
    want_picture();
}

void SpaceView::showEvent(QShowEvent*) {
    pacer_->set_held(false);
}

void SpaceView::hideEvent(QHideEvent*) {
    pacer_->set_held(true);
}

void SpaceView::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    // Another screen may have another scale.
    if (event->type() == QEvent::ParentChange || event->type() == QEvent::ScreenChangeInternal) {
        if (pacer_ && wanted_size() != QSize(picture_.colour.width, picture_.colour.height)) want_picture();
    }
}

bool SpaceView::can_move() const {
    return is_free() || experiment_pose_ || shows_sphere(scene_);
}

SpaceView::Drag SpaceView::drag_for(const QMouseEvent& event) const {
    if (event.button() != Qt::LeftButton) return shows_sphere(scene_) ? Drag::none : Drag::slide;
    if (shows_sphere(scene_)) return Drag::press;
    if (event.modifiers() & Qt::ShiftModifier) return Drag::slide;
    return event.modifiers() & Qt::ControlModifier ? Drag::look : Drag::press;
}

void SpaceView::mousePressEvent(QMouseEvent* event) {
    if (drag_ != Drag::none || !picture_area().contains(event->position().toPoint())) return;
    drag_ = drag_for(*event);
    last_position_ = press_position_ = event->position();
    setFocus(Qt::MouseFocusReason);
}

void SpaceView::mouseMoveEvent(QMouseEvent* event) {
    const QPointF delta = event->position() - last_position_;
    if (drag_ == Drag::press && (event->position() - press_position_).manhattanLength() > click_reach)
        drag_ = Drag::orbit;
    if (drag_ != Drag::press) last_position_ = event->position();
    cursor_inside_ = picture_area().contains(event->position().toPoint());
    if (drag_ == Drag::none || drag_ == Drag::press)
        return last_position_ = event->position(), update_hover();
    if (can_move()) drag_camera(delta);
}

void SpaceView::drag_camera(QPointF delta) {
    const double height = std::max(1, picture_area().height());
    const double turn = radians_per_view / height;
    if (drag_ == Drag::orbit) move_camera(orbited(pose(), -delta.x() * turn, delta.y() * turn));
    if (drag_ == Drag::look) move_camera(looked(pose(), -delta.x() * turn / 2, -delta.y() * turn / 2));
    if (drag_ == Drag::slide) move_camera(slid(pose(), -delta.x() / height, delta.y() / height));
}

void SpaceView::mouseReleaseEvent(QMouseEvent* event) {
    const Drag drag = std::exchange(drag_, Drag::none);
    last_position_ = event->position();
    if (drag == Drag::press) {
        const Element element = element_at(event->position());
        emit element_clicked(element.layer, element.element);
    } else if (drag != Drag::none) {
        finish_gesture();
    }
    update_hover();
}

void SpaceView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton && picture_area().contains(event->position().toPoint()))
        frame_all();
}

void SpaceView::wheelEvent(QWheelEvent* event) {
    const double steps = event->angleDelta().y() / 120.0;
    event->accept();
    if (steps == 0 || !can_move()) return;
    const double factor = std::pow(wheel_step, -steps);
    const QRectF area = picture_area();
    const QPointF from_middle = event->position() - area.center();
    const QPointF at(from_middle.x() / std::max(1.0, area.height()),
                     -from_middle.y() / std::max(1.0, area.height()));
    move_camera(shows_sphere(scene_) ? sphere_dollied(pose(), factor) : dollied_towards(pose(), at, factor));
    settle_timer_.start();
}

void SpaceView::keyPressEvent(QKeyEvent* event) {
    const bool plain = !(event->modifiers() & (Qt::ControlModifier | Qt::AltModifier));
    if (event->key() == Qt::Key_Home) return use_experiment_camera();
    if (event->key() == Qt::Key_F && plain) return frame_all();
    if (!is_fly_key(event->key()) || !plain || !can_move() || shows_sphere(scene_))
        return QWidget::keyPressEvent(event);
    if (!event->isAutoRepeat()) keys_.insert(event->key());
    if (fly_timer_.isActive()) return;
    fly_clock_.start();
    fly_timer_.start();
}

void SpaceView::keyReleaseEvent(QKeyEvent* event) {
    if (event->isAutoRepeat() || !keys_.contains(event->key())) return QWidget::keyReleaseEvent(event);
    fly_step();  // a tap shorter than the timer's beat moves, too
    keys_.remove(event->key());
    if (!keys_.isEmpty()) return;
    fly_timer_.stop();
    finish_gesture();
}

void SpaceView::fly_step() {
    const double seconds = std::clamp(fly_clock_.restart() / 1000.0, 0.004, 0.1);
    const bool fast = QGuiApplication::keyboardModifiers() & Qt::ShiftModifier;
    const double speed = glm::length(bounds_.high - bounds_.low) / crossing_seconds * (fast ? 4 : 1);
    const auto axis = [&](int plus, int minus) {
        return speed * seconds * ((keys_.contains(plus) ? 1 : 0) - (keys_.contains(minus) ? 1 : 0));
    };
    move_camera(
        flown(pose(), axis(Qt::Key_D, Qt::Key_A), axis(Qt::Key_E, Qt::Key_Q), axis(Qt::Key_W, Qt::Key_S)));
}

void SpaceView::move_camera(const CameraPose& pose) {
    if (shows_sphere(scene_)) {
        if (pose == sphere_pose_) return;
        sphere_pose_ = pose;
    } else {
        if (scene_.camera == pose) return;
        scene_.camera = pose;
    }
    gesture_ = true;
    hovered_ = {};
    overlay_.hover.clear();
    scene_updated();
}

void SpaceView::finish_gesture() {
    settle_timer_.stop();
    if (!gesture_) return;
    gesture_ = false;
    if (divisor_ > 1)
        want_picture();  // the last picture was a coarse one
    else if (pacer_->is_idle())
        refine_later();
    emit scene_changed(scene_);
}

void SpaceView::update_hover() {
    const bool still = cursor_inside_ && drag_ == Drag::none;
    const Element element = still ? element_at(last_position_) : Element{};
    overlay_.hover_at = last_position_ - QPointF(picture_area().topLeft());
    if (!(element == hovered_)) {
        hovered_ = element;
        hover_values_.clear();
        setCursor(element.layer >= 0 ? Qt::PointingHandCursor : Qt::ArrowCursor);
        emit element_hovered(element.layer, element.element);
    }
    overlay_.hover = hover_text(hovered_);
    overlay_widget_->update();
}

QString SpaceView::hover_text(const Element& element) const {
    if (element.layer < 0 || std::size_t(element.layer) >= scene_.layers.size()) return {};
    const SpaceLayer& layer = scene_.layers[std::size_t(element.layer)];
    QString text = tr("%1 · element %2").arg(QString::fromStdString(layer.label)).arg(element.element);
    if (!hover_values_.isEmpty()) text += QLatin1Char('\n') + hover_values_;
    for (const LayerInfo& info : picture_.layers) {
        if (info.key != layer.key) continue;
        for (const SpaceSelector& selector : selectors_)
            for (const Field& field : info.fields)
                if (field.name == selector.key && field.type != FieldType::f32 && field.count == 1)
                    text += QLatin1Char('\n') +
                            tr("click: show its %1").arg(QString::fromStdString(selector.label).toLower());
        break;
    }
    return text;
}

void SpaceView::leaveEvent(QEvent*) {
    cursor_inside_ = false;
    update_hover();
}

void SpaceView::focusOutEvent(QFocusEvent* event) {
    QWidget::focusOutEvent(event);
    keys_.clear();
    fly_timer_.stop();
    if (drag_ == Drag::none) finish_gesture();
}

}  // namespace ir::widgets
