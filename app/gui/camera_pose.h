#pragma once

#include "renderers/scene/scene.h"
#include "widgets/image/camera_motion.h"

namespace ir::gui {

/// The renderers' camera as views move it, and back.
inline widgets::CameraPose pose_of(const scene::Camera& camera) {
    return {camera.eye,          camera.target, camera.up, glm::degrees(double(camera.fov_y)),
            camera.orthographic, camera.height};
}

inline scene::Camera camera_of(const widgets::CameraPose& pose) {
    scene::Camera camera;
    camera.eye = pose.eye;
    camera.target = pose.target;
    camera.up = pose.up;
    camera.fov_y = float(glm::radians(pose.fov_y_degrees));
    camera.orthographic = pose.orthographic;
    camera.height = float(pose.height);
    return camera;
}

}  // namespace ir::gui
