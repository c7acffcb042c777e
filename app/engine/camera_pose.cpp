#include "app/engine/camera_pose.h"

#include <nlohmann/json.hpp>

namespace ir::engine {

nlohmann::ordered_json camera_json(const scene::Camera& camera) {
    const auto pose = pose_of(camera);
    const auto vector = [](const auto& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
    nlohmann::ordered_json json{
        {"eye", vector(pose.eye)}, {"target", vector(pose.target)}, {"up", vector(pose.up)}};
    if (pose.orthographic)
        json["height"] = pose.height;
    else
        json["fov_y_degrees"] = pose.fov_y_degrees;
    return json;
}

}  // namespace ir::engine
