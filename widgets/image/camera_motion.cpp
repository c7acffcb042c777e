#include "widgets/image/camera_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace ir::widgets {
namespace {

glm::dvec3 turned(const glm::dvec3& v, double angle, const glm::dvec3& axis) {
    return glm::dvec3(glm::rotate(glm::dmat4(1), angle, axis) * glm::dvec4(v, 0));
}

/// `arm` (from the fixed point to the moving one) turned by yaw and a pitch that keeps off the poles.
glm::dvec3 turned_arm(const glm::dvec3& arm, const CameraPose& pose, double yaw, double pitch) {
    const glm::dvec3 up = glm::normalize(pose.up);
    const double elevation = std::asin(std::clamp(glm::dot(glm::normalize(arm), up), -1.0, 1.0));
    const double limit = std::numbers::pi / 2 - 0.01;
    const double wanted = std::clamp(elevation + pitch, -limit, limit);
    glm::dvec3 axis = glm::cross(arm, up);
    if (glm::length(axis) < 1e-9 * glm::length(arm)) axis = camera_axes(pose).right;
    const glm::dvec3 raised = turned(arm, wanted - elevation, glm::normalize(axis));
    return turned(raised, yaw, up);
}

}  // namespace

CameraAxes camera_axes(const CameraPose& pose) {
    const glm::dvec3 forward = glm::normalize(pose.target - pose.eye);
    glm::dvec3 right = glm::cross(forward, pose.up);
    if (glm::length(right) < 1e-5 * glm::length(pose.up)) {  // looking along up: as renderers do
        const glm::dvec3 other = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
        right = glm::cross(forward, other);
    }
    right = glm::normalize(right);
    return {right, glm::cross(right, forward), forward};
}

double half_angle(const CameraPose& pose) {
    return pose.fov_y_degrees * std::numbers::pi / 360;
}

double height_at_target(const CameraPose& pose) {
    return height_at(pose, pose.target);
}

double height_at(const CameraPose& pose, const glm::dvec3& point) {
    if (pose.orthographic) return pose.height;
    return 2 * glm::dot(point - pose.eye, camera_axes(pose).forward) * std::tan(half_angle(pose));
}

Sight sight_through(const CameraPose& pose, double aspect, glm::dvec2 place) {
    const auto axes = camera_axes(pose);
    const auto off_axis = (place.x - 0.5) * aspect * axes.right + (0.5 - place.y) * axes.up;
    if (pose.orthographic) return {pose.eye + pose.height * off_axis, axes.forward};
    return {pose.eye, glm::normalize(axes.forward + 2 * std::tan(half_angle(pose)) * off_axis)};
}

std::optional<glm::dvec2> place_of(const CameraPose& pose, double aspect, const glm::dvec3& point) {
    const auto axes = camera_axes(pose);
    const auto towards = point - pose.eye;
    const double height = height_at(pose, point);
    if (!(glm::dot(towards, axes.forward) > 0) || !(height > 0)) return {};
    return glm::dvec2(0.5 + glm::dot(towards, axes.right) / (height * aspect),
                      0.5 - glm::dot(towards, axes.up) / height);
}

CameraPose orbited(const CameraPose& pose, double yaw, double pitch) {
    CameraPose result = pose;
    result.eye = pose.target + turned_arm(pose.eye - pose.target, pose, yaw, pitch);
    return result;
}

CameraPose looked(const CameraPose& pose, double yaw, double pitch) {
    CameraPose result = pose;
    result.target = pose.eye + turned_arm(pose.target - pose.eye, pose, yaw, pitch);
    return result;
}

CameraPose dollied(const CameraPose& pose, double factor) {
    CameraPose result = pose;
    if (pose.orthographic) {
        result.height *= factor;
        return result;
    }
    result.eye = pose.target + (pose.eye - pose.target) * factor;
    return result;
}

CameraPose slid(const CameraPose& pose, double right, double up) {
    const double height = height_at_target(pose);
    return flown(pose, right * height, up * height, 0);
}

CameraPose flown(const CameraPose& pose, double right, double up, double forward) {
    const auto frame = camera_axes(pose);
    const glm::dvec3 step = frame.right * right + frame.up * up + frame.forward * forward;
    CameraPose result = pose;
    result.eye += step;
    result.target += step;
    return result;
}

}  // namespace ir::widgets
