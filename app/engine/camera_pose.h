#pragma once

#include "renderers/core/camera_pose.h"
#include "renderers/scene/scene.h"

namespace ir::engine {

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
