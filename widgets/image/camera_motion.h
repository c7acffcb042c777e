#pragma once

#include <optional>

#include "renderers/core/camera_pose.h"

namespace ir::widgets {

using ir::CameraPose;

/// The axes of a camera, each of length one.
struct CameraAxes {
    glm::dvec3 right, up, forward;
};
CameraAxes camera_axes(const CameraPose& pose);

/// Metres across the picture's height at the target, and at the depth of a point.
double height_at_target(const CameraPose& pose);
double height_at(const CameraPose& pose, const glm::dvec3& point);

/// A line of sight in world space; the direction has length one.
struct Sight {
    glm::dvec3 origin, direction;
};
/// Through a place in a picture of that width / height: (0, 0) is its upper left corner, (1, 1) its lower
/// right one. As renderers see it (scene::make_view).
Sight sight_through(const CameraPose& pose, double aspect, glm::dvec2 place);
/// Where in the picture a point is seen, also beyond its edges; none: not in front of the camera.
std::optional<glm::dvec2> place_of(const CameraPose& pose, double aspect, const glm::dvec3& point);
/// Of the vertical field of view, radians.
double half_angle(const CameraPose& pose);

/// Turns the eye about the target: `yaw` about up, `pitch` about the camera's right, radians. The pose never
/// tips over the pole.
CameraPose orbited(const CameraPose& pose, double yaw, double pitch);
/// Turns the target about the eye.
CameraPose looked(const CameraPose& pose, double yaw, double pitch);
/// Scales the distance to the target (orthographic: the height) by `factor`.
CameraPose dollied(const CameraPose& pose, double factor);
/// Moves eye and target by fractions of the picture's height at the target.
CameraPose slid(const CameraPose& pose, double right, double up);
/// Moves eye and target by metres along the camera's axes.
CameraPose flown(const CameraPose& pose, double right, double up, double forward);

}  // namespace ir::widgets
