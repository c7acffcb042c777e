#pragma once

#include <tuple>

#include "renderers/core/camera_pose.h"
#include "renderers/scene/scene.h"

namespace ir::engine {

/// All that decides what a camera sees at time 0.
inline auto seen_by(const scene::Camera& c) {
    return std::tie(c.eye.x, c.eye.y, c.eye.z, c.target.x, c.target.y, c.target.z, c.up.x, c.up.y, c.up.z,
                    c.fov_y, c.orthographic, c.height);
}

/// The renderers' camera as documents have it and views move it, and back.
inline CameraPose pose_of(const scene::Camera& camera) {
    return {{camera.eye, camera.target, camera.up},
            glm::degrees(double(camera.fov_y)),
            camera.orthographic,
            camera.height};
}

inline scene::Camera camera_of(const CameraPose& pose) {
    scene::Camera camera;
    camera.eye = pose.eye;
    camera.target = pose.target;
    camera.up = pose.up;
    camera.fov_y = float(glm::radians(pose.fov_y_degrees));
    camera.orthographic = pose.orthographic;
    camera.height = float(pose.height);
    return camera;
}

/// As statistics and the list of a scene have it.
nlohmann::ordered_json camera_json(const scene::Camera& camera);

}  // namespace ir::engine
