#pragma once

#include <glm/glm.hpp>

namespace ir {

/// From where to where a camera looks: metres, world space, +Y up unless `up` says otherwise.
struct CameraAim {
    glm::dvec3 eye{0, 0, 5}, target{0}, up{0, 1, 0};
    CameraAim& aim() { return *this; }
    bool operator==(const CameraAim&) const = default;
};

/// A camera as documents have it and views move it; scene::Camera is what renderers see.
struct CameraPose : CameraAim {
    double fov_y_degrees = 45;
    bool orthographic = false;
    double height = 2;  ///< metres across the image's height, orthographic only
    CameraPose& pose() { return *this; }
    bool operator==(const CameraPose&) const = default;
};

}  // namespace ir
