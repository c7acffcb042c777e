#include "widgets/image/light_handles.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace ir::widgets {
namespace {

using Shape = PlacedLight::Shape;

/// Sine of the angle between an axis and a line of sight below which the line says nothing of a place on the
/// axis.
constexpr double min_sine = 0.02;
/// A drag goes at most so many heights of the picture at the light: an axis ends at its vanishing point.
constexpr double max_heights = 100;

glm::dvec3 axis_of(LightHandle handle) {
    return {handle == LightHandle::x, handle == LightHandle::y, handle == LightHandle::z};
}

/// Horizontal and vertical, as scene::light_frame has them.
CameraAxes axes_of(const PlacedLight& light) {
    CameraPose along;
    along.eye = light.position;
    along.target = light.position + light.direction;
    return camera_axes(along);
}

}  // namespace

std::vector<LightHandle> handles_of(const PlacedLight& light) {
    using enum LightHandle;
    if (!light.moves()) return {direction};
    if (!light.turns()) return {centre, x, y, z};
    return {direction, centre, x, y, z};
}

glm::dvec3 end_of(const PlacedLight& light, LightHandle handle, double length) {
    // The longest one, so that it is never under an axis.
    constexpr double direction_length = 1.4;
    if (handle == LightHandle::direction) return light.position + direction_length * length * light.direction;
    return light.position + length * axis_of(handle);
}

std::vector<glm::dvec3> outline_of(const PlacedLight& light, double length) {
    constexpr int corners = 48;
    std::vector<glm::dvec3> outline;
    if (light.shape == Shape::point || light.shape == Shape::sun) return outline;
    const auto axes = axes_of(light);
    if (light.shape == Shape::rectangle) {
        for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
            outline.push_back(light.position +
                              0.5 * (x * light.size.x * axes.right + y * light.size.y * axes.up));
        return outline;
    }
    const bool is_cone = light.shape == Shape::cone;
    const double angle = glm::radians(light.half_angle);
    const auto centre =
        is_cone ? light.position + length * std::cos(angle) * light.direction : light.position;
    const auto radii = is_cone ? glm::dvec2(length * std::sin(angle)) : 0.5 * light.size;
    for (int i = 0; i < corners; ++i) {
        const double turn = 2 * std::numbers::pi * i / corners;
        outline.push_back(centre + std::cos(turn) * radii.x * axes.right +
                          std::sin(turn) * radii.y * axes.up);
    }
    return outline;
}

LightDrag::LightDrag(const PlacedLight& start, LightHandle handle, const CameraPose& camera, double length)
    : start_(start), last_(start), handle_(handle), camera_(camera), length_(length) {
    const auto view = camera.orthographic ? camera_axes(camera).forward : start.position - camera.eye;
    points_away_ = glm::dot(start.direction, view) > 0;
}

/// How far along the axis the point lies that is closest to the line of sight.
std::optional<double> LightDrag::along_axis(const Sight& sight) const {
    const auto axis = axis_of(handle_);
    const double cosine = glm::dot(axis, sight.direction), sine_squared = 1 - cosine * cosine;
    if (sine_squared < min_sine * min_sine) return {};
    const auto between = sight.origin - start_.position;
    return (glm::dot(between, axis) - glm::dot(between, sight.direction) * cosine) / sine_squared;
}

std::optional<glm::dvec3> LightDrag::position_at(const Sight& sight) const {
    const auto forward = camera_axes(camera_).forward;
    glm::dvec3 moved(0);
    if (handle_ == LightHandle::centre) {
        const double cosine = glm::dot(sight.direction, forward);
        if (!(cosine > 0)) return {};
        const double distance = glm::dot(start_.position - sight.origin, forward) / cosine;
        moved = sight.origin + distance * sight.direction - start_.position;
    } else {
        const auto along = along_axis(sight);
        if (!along) return {};
        moved = (*along - length_) * axis_of(handle_);
    }
    const auto position = start_.position + moved;
    const bool is_in_front = camera_.orthographic || glm::dot(position - camera_.eye, forward) > 0;
    if (!is_in_front || glm::length(moved) > max_heights * height_at(camera_, start_.position)) return {};
    return position;
}

/// On the sphere that the handle's end runs over; beside it, on its edge.
glm::dvec3 LightDrag::direction_at(const Sight& sight) {
    const double radius = glm::length(end_of(start_, handle_, length_) - start_.position);
    const auto nearest =
        sight.origin + glm::dot(start_.position - sight.origin, sight.direction) * sight.direction;
    const double off = glm::length(nearest - start_.position);
    const bool is_outside = off >= radius;
    if (is_outside && !is_outside_) points_away_ = !points_away_;
    is_outside_ = is_outside;
    if (is_outside) return glm::normalize(nearest - start_.position);
    const double half = std::sqrt(radius * radius - off * off);
    return glm::normalize(nearest + (points_away_ ? half : -half) * sight.direction - start_.position);
}

PlacedLight LightDrag::to(const Sight& sight) {
    if (handle_ == LightHandle::direction)
        last_.direction = direction_at(sight);
    else
        last_.position = position_at(sight).value_or(last_.position);
    return last_;
}

PlacedLight nudged(const PlacedLight& light, const CameraPose& camera, const glm::dvec3& right_up_forward) {
    const auto axes = camera_axes(camera);
    const double height = height_at(camera, light.position);
    // At the camera and behind it nothing is seen of the light.
    const auto step = (height > 0 ? height : height_at_target(camera)) * right_up_forward;
    auto moved = light;
    moved.position += step.x * axes.right + step.y * axes.up + step.z * axes.forward;
    return moved;
}

PlacedLight turned(const PlacedLight& light, const CameraPose& camera, double yaw, double pitch) {
    const auto axes = camera_axes(camera);
    auto changed = light;
    changed.direction =
        glm::normalize(glm::angleAxis(yaw, axes.up) * glm::angleAxis(pitch, axes.right) * light.direction);
    return changed;
}

}  // namespace ir::widgets
