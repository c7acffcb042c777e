#include "renderers/scene/placement.h"

#include <cmath>

namespace ir::scene {
namespace {

glm::vec3 direction_or(glm::vec3 direction, glm::vec3 otherwise) {
    const float length = glm::length(direction);
    return length > 0 && std::isfinite(length) ? direction / length : otherwise;
}

}  // namespace

Camera placed(Camera camera, const glm::mat4& world_from_node) {
    const auto forward = direction_or(-glm::vec3(world_from_node[2]), {0, 0, -1});
    camera.eye = glm::vec3(world_from_node[3]);
    camera.up = direction_or(glm::vec3(world_from_node[1]), {0, 1, 0});
    // The target keeps a distance that floats can tell from the eye.
    camera.target = camera.eye + forward * std::max(1.0f, 1e-3f * glm::length(camera.eye));
    return camera;
}

Light placed(Light light, const glm::mat4& world_from_node) {
    light.position = glm::vec3(world_from_node * glm::vec4(light.position, 1));
    light.direction = direction_or(glm::mat3(world_from_node) * light.direction, {0, -1, 0});
    light.node = -1;
    return light;
}

}  // namespace ir::scene
