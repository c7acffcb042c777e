#include "widgets/image/light_tool.h"

#include <QKeyEvent>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "widgets/image/arrow_keys.h"
#include "widgets/image/decimals.h"

namespace ir::widgets {
namespace {

/// Logical pixels. Lines that look shorter than min_line point at the camera or away from it.
constexpr double handle_pixels = 64, handle_reach = 8, min_line = 18, ring_radius = 14;
/// An axis is at most this part of the view's shorter side, so that handles fit small views.
constexpr double max_part = 0.2;
/// The part of an axis next to the light belongs to the centre.
constexpr double free_part = 0.25;

constexpr double nudge_step = 0.01;                   // of the picture's height at the light
constexpr double nudge_turn = std::numbers::pi / 72;  // 2.5°
constexpr double nudge_large = 10;                    // times, with Shift

double distance_to_line(QPointF at, QPointF from, QPointF to) {
    const QPointF along = to - from, off = at - from;
    const double squared = QPointF::dotProduct(along, along);
    const double part = squared > 0 ? std::clamp(QPointF::dotProduct(off, along) / squared, 0.0, 1.0) : 0;
    const QPointF between = off - part * along;
    return std::hypot(between.x(), between.y());
}

double aspect_of(const CanvasState& state) {
    const QSizeF size = state.transform.image_size();
    return size.width() / std::max(1.0, size.height());
}

}  // namespace

double handle_length(const CanvasState& state, qreal pixel_ratio) {
    const double shown = state.transform.image_size().height() * state.transform.zoom();
    const QSizeF view = state.transform.view_size();
    const double pixels =
        std::min(handle_pixels * pixel_ratio, max_part * std::min(view.width(), view.height()));
    return pixels / std::max(1.0, shown) * height_at(state.camera, state.light->position);
}

std::optional<QPointF> seen_at(const CanvasState& state, const glm::dvec3& point) {
    const auto place = place_of(state.camera, aspect_of(state), point);
    if (!place) return {};
    const QSizeF size = state.transform.image_size();
    return state.transform.view_from_image({place->x * size.width(), place->y * size.height()});
}

double Grip::distance_to(QPointF position) const {
    if (ring > 0) return std::abs(std::hypot(position.x() - centre.x(), position.y() - centre.y()) - ring);
    return distance_to_line(position, centre + free_part * (end - centre), end);
}

std::optional<Grip> grip_of(const CanvasState& state, LightHandle handle, qreal pixel_ratio) {
    const auto centre = seen_at(state, state.light->position);
    const auto end = seen_at(state, end_of(*state.light, handle, handle_length(state, pixel_ratio)));
    if (!centre || !end) return {};
    if (handle == LightHandle::centre) return Grip{*centre, *centre};
    const QPointF along = *end - *centre;
    if (std::hypot(along.x(), along.y()) >= min_line * pixel_ratio) return Grip{*centre, *end};
    if (handle != LightHandle::direction) return {};
    return Grip{*centre, *end, ring_radius * pixel_ratio};
}

double LightTool::length() const {
    return handle_length(state_, view_.devicePixelRatioF());
}

bool LightTool::hover(QPointF position) {
    const qreal ratio = view_.devicePixelRatioF();
    auto found = LightHandle::none;
    if (is_active()) {
        double nearest = handle_reach * ratio;
        for (const auto handle : handles_of(*state_.light)) {
            const auto grip = grip_of(state_, handle, ratio);
            const double off = grip ? grip->distance_to(position * ratio) : nearest;
            if (off >= nearest) continue;
            nearest = off;
            found = handle;
        }
    }
    return std::exchange(state_.light_handle, found) != found;
}

void LightTool::press(QPointF position) {
    hover(position);
    if (!is_over_handle()) return;
    finish_keys();
    drag_ = LightDrag(*state_.light, state_.light_handle, state_.camera, length());
    offset_ = *seen_at(state_, end_of(*state_.light, state_.light_handle, length())) -
              position * view_.devicePixelRatioF();
    dragging_ = true;
}

void LightTool::drag(QPointF position) {
    if (!dragging_ || !is_active()) return;
    const QPointF at = state_.transform.image_from_view(position * view_.devicePixelRatioF() + offset_);
    const QSizeF size = state_.transform.image_size();
    const auto sight =
        sight_through(state_.camera, aspect_of(state_), {at.x() / size.width(), at.y() / size.height()});
    const auto light = drag_.to(sight);
    if (drag_.handle() == LightHandle::direction)
        turn_to(light.direction);
    else
        move_to(light.position, drag_.start().position);
}

void LightTool::move_to(const glm::dvec3& position, const glm::dvec3& from) {
    emit moved(moved_in_decimals(from, position, height_at(state_.camera, position)));
}

void LightTool::turn_to(const glm::dvec3& direction) {
    emit turned(moved_in_decimals(state_.light->direction, direction, 1));
}

void LightTool::release() {
    if (std::exchange(dragging_, false)) emit finished(true);
}

QString LightTool::hint() const {
    switch (state_.light_handle) {
        case LightHandle::centre:
            return tr(
                "Drag moves the light parallel to the picture  ·  arrows nudge  ·  Esc takes a drag back");
        case LightHandle::x:
            return tr("Drag moves the light along x  ·  Esc takes it back");
        case LightHandle::y:
            return tr("Drag moves the light along y  ·  Esc takes it back");
        case LightHandle::z:
            return tr("Drag moves the light along z  ·  Esc takes it back");
        case LightHandle::direction:
            return tr("Drag turns the light; over the edge and back, to the other side  ·  Alt+arrows nudge");
        default:
            break;
    }
    if (!is_active() || !state_.light->tells || seen_at(state_, state_.light->position)) return {};
    return tr("%1: at the camera or behind it  ·  Ctrl+↑ moves it ahead").arg(state_.light->name);
}

bool LightTool::takes(const QKeyEvent& event) const {
    if (!is_active()) return false;
    if (event.key() == Qt::Key_Escape) return dragging_ && event.modifiers() == Qt::NoModifier;
    const auto modifiers = event.modifiers() & ~Qt::KeyboardModifiers(Qt::KeypadModifier | Qt::ShiftModifier);
    if (dragging_ || arrow_of(event.key()).isNull()) return false;
    if (modifiers == Qt::AltModifier) return state_.light->turns();
    const bool is_upright = arrow_of(event.key()).x() == 0;
    return state_.light->moves() &&
           (modifiers == Qt::NoModifier || (modifiers == Qt::ControlModifier && is_upright));
}

void LightTool::press_key(const QKeyEvent& event) {
    if (event.key() == Qt::Key_Escape) {
        dragging_ = false;
        return emit finished(false);
    }
    nudging_ = true;
    const QPoint step = arrow_of(event.key());
    const glm::dvec2 arrow(step.x(), -step.y());  // y up, as the camera has it
    const double times = event.modifiers() & Qt::ShiftModifier ? nudge_large : 1;
    if (event.modifiers() & Qt::AltModifier) {
        const auto by = times * nudge_turn * arrow;
        return turn_to(widgets::turned(*state_.light, state_.camera, by.x, by.y).direction);
    }
    const auto by = times * nudge_step * arrow;
    const bool is_depth = event.modifiers() & Qt::ControlModifier;
    const auto along = is_depth ? glm::dvec3(0, 0, by.y) : glm::dvec3(by, 0);
    move_to(nudged(*state_.light, state_.camera, along).position, state_.light->position);
}

void LightTool::finish_keys() {
    if (std::exchange(nudging_, false)) emit finished(true);
}

}  // namespace ir::widgets
