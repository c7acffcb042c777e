#include "widgets/space/space_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ir::widgets {

CameraPose dollied_towards(const CameraPose& pose, QPointF at, double factor) {
    const double gained = (1 - factor) / factor;  // in heights of the nearer picture
    return slid(dollied(pose, factor), at.x() * gained, at.y() * gained);
}

CameraPose framed(const CameraPose& pose, const SpaceBox& box, double aspect) {
    const double radius = std::max(glm::length(box.high - box.low) / 2, 1e-6);
    const double narrow = std::min(aspect, 1.0);
    CameraPose result = pose;
    result.target = (box.low + box.high) / 2.0;
    const double half = std::atan(std::tan(half_angle(pose)) * narrow);
    result.eye = result.target - camera_axes(pose).forward * (radius / std::sin(half));
    if (pose.orthographic) result.height = 2 * radius / narrow;
    return result;
}

CameraPose sphere_pose() {
    CameraPose pose;
    pose.eye = glm::normalize(glm::dvec3(1, 0.6, 1.6)) * 3.2;
    pose.target = {0, 0, 0};
    pose.fov_y_degrees = 40;
    return pose;
}

CameraPose fitted_below(const CameraPose& pose, double aspect, double strip) {
    const double below = 1 - strip;
    if (!(aspect > 0) || !(below > 0)) return pose;
    const double opened = 1 / (below * std::min(1.0, aspect / below));
    const double half = std::tan(half_angle(pose)) * opened;
    CameraPose result = pose;
    result.fov_y_degrees = std::atan(half) * 360 / std::numbers::pi;
    result.height = pose.height * opened;
    const double reach = pose.orthographic ? result.height / 2 : glm::length(pose.target - pose.eye) * half;
    const auto up = camera_axes(pose).up * (reach * strip);
    result.eye += up;
    result.target += up;
    return result;
}

CameraPose sphere_dollied(const CameraPose& pose, double factor) {
    constexpr double nearest = 1.3, furthest = 20;
    const double distance = glm::length(pose.eye);
    return dollied(pose, std::clamp(distance * factor, nearest, furthest) / distance);
}

double round_length(double max_length) {
    if (!(max_length > 0) || !std::isfinite(max_length)) return 0;
    const double ten = std::pow(10, std::floor(std::log10(max_length)));
    for (const double times : {5.0, 2.0})
        if (times * ten <= max_length) return times * ten;
    return ten;
}

}  // namespace ir::widgets
