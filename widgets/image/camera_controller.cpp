#include "widgets/image/camera_controller.h"

#include <QGuiApplication>
#include <QKeyEvent>
#include <algorithm>
#include <numbers>

namespace ir::widgets {
namespace {

constexpr double radians_per_view = std::numbers::pi;
/// A camera that was moved by wheel or keys is left alone after so long.
constexpr int settle_ms = 350;
constexpr int fly_step_ms = 16;
constexpr double fast = 4;

}  // namespace

CameraController::CameraController(QObject* parent) : QObject(parent) {
    fly_timer_.setInterval(fly_step_ms);
    settle_timer_.setInterval(settle_ms);
    settle_timer_.setSingleShot(true);
    connect(&fly_timer_, &QTimer::timeout, this, &CameraController::fly);
    connect(&settle_timer_, &QTimer::timeout, this, &CameraController::finish);
}

void CameraController::drag(QPointF delta, double view_height, double picture_height) {
    const QPointF turn = delta * (radians_per_view / std::max(1.0, view_height));
    const QPointF slide = delta / std::max(1.0, picture_height);
    switch (drag_) {
        case Drag::orbit:
            return move_to(orbited(pose_, -turn.x(), turn.y()));
        case Drag::look:
            return move_to(looked(pose_, -turn.x() / 2, -turn.y() / 2));
        case Drag::slide:
            return move_to(slid(pose_, -slide.x(), slide.y()));
    }
}

void CameraController::set_pose(const CameraPose& pose) {
    if (pose == pose_) return;
    pose_ = pose;
    emit posed();
}

void CameraController::move_to(const CameraPose& pose) {
    if (pose == pose_) return;
    set_pose(pose);
    moving_ = true;
    emit moved(pose_);
}

bool CameraController::is_fly_key(int key) {
    return key == Qt::Key_W || key == Qt::Key_A || key == Qt::Key_S || key == Qt::Key_D || key == Qt::Key_Q ||
           key == Qt::Key_E;
}

void CameraController::press_key(const QKeyEvent& event) {
    if (!event.isAutoRepeat()) keys_.insert(event.key());
    if (fly_timer_.isActive()) return;
    fly_clock_.start();
    fly_timer_.start();
}

bool CameraController::release_key(const QKeyEvent& event) {
    fly();  // a tap shorter than the timer's beat moves, too
    keys_.remove(event.key());
    if (keys_.isEmpty()) fly_timer_.stop();
    return keys_.isEmpty();
}

void CameraController::drop_keys() {
    keys_.clear();
    fly_timer_.stop();
}

void CameraController::fly() {
    const double seconds = std::clamp(fly_clock_.restart() / 1000.0, 0.004, 0.1);
    const bool is_fast = QGuiApplication::keyboardModifiers() & Qt::ShiftModifier;
    const double step = fly_speed_ * seconds * (is_fast ? fast : 1);
    const auto axis = [&](int plus, int minus) {
        return step * ((keys_.contains(plus) ? 1 : 0) - (keys_.contains(minus) ? 1 : 0));
    };
    move_to(flown(pose_, axis(Qt::Key_D, Qt::Key_A), axis(Qt::Key_E, Qt::Key_Q), axis(Qt::Key_W, Qt::Key_S)));
}

void CameraController::finish() {
    settle_timer_.stop();
    if (!moving_) return;
    moving_ = false;
    emit finished();
}

}  // namespace ir::widgets
