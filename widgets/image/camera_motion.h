#pragma once

#include <glm/glm.hpp>

namespace ir::widgets {

/// A camera as the view moves it: metres, world space, +Y up unless `up` says otherwise.
struct CameraPose {
    glm::dvec3 eye{0, 0, 5}, target{0}, up{0, 1, 0};
    double fov_y_degrees = 45;
    bool orthographic = false;
    double height = 2;  ///< metres across the image's height, orthographic only
    bool operator==(const CameraPose&) const = default;
};

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
