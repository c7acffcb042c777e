#pragma once

#include <algorithm>
#include <limits>

#include "renderers/scene/scene.h"

namespace ir::scene {

/// Distance to the first triangle along a ray, by brute force; infinite for none.
inline float first_hit(const Scene& scene, glm::vec3 origin, glm::vec3 direction, bool sees_masked = true) {
    float nearest = std::numeric_limits<float>::infinity();
    for (const auto& mesh : scene.meshes) {
        if (!sees_masked && scene.materials[mesh.material].alpha_mode == AlphaMode::mask) continue;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const glm::vec3 a = mesh.positions[mesh.indices[i]];
            const glm::vec3 ab = mesh.positions[mesh.indices[i + 1]] - a;
            const glm::vec3 ac = mesh.positions[mesh.indices[i + 2]] - a;
            const glm::vec3 p = glm::cross(direction, ac);
            const float determinant = glm::dot(ab, p);
            if (std::abs(determinant) < 1e-14f) continue;
            const float u = glm::dot(origin - a, p) / determinant;
            const glm::vec3 q = glm::cross(origin - a, ab);
            const float v = glm::dot(direction, q) / determinant, t = glm::dot(ac, q) / determinant;
            if (u >= 0 && v >= 0 && u + v <= 1 && t > 0) nearest = std::min(nearest, t);
        }
    }
    return nearest;
}

}  // namespace ir::scene
