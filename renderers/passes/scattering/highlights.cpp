#include "renderers/passes/scattering/highlights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderers/passes/scattering/microfacets.h"

namespace ir::passes {
namespace {

/// Largest turn of vertex normals along an edge, rad/m.
float triangle_curvature(const scene::World& world, std::uint32_t triangle) {
    float largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto a = world.indices[3 * std::size_t{triangle} + i],
                   b = world.indices[3 * std::size_t{triangle} + (i + 1) % 3];
        largest =
            std::max(largest, glm::distance(world.normals[a], world.normals[b]) /
                                  std::max(glm::distance(world.positions[a], world.positions[b]), 1e-6f));
    }
    return largest;
}

}  // namespace

float slope_variance(const scene::World& world, std::uint32_t triangle, float distance_m, float solid_angle) {
    const float radius = std::sqrt(solid_angle / std::numbers::pi_v<float>);  // at 1 m
    const float turn = radius * distance_m * triangle_curvature(world, triangle);
    return radius * radius / 16 + turn * turn / 4;
}

float widened_roughness(float roughness, float variance) {
    const float alpha = roughness * roughness;
    return std::min(std::sqrt(std::sqrt(alpha * alpha + 2 * variance)), 1.0f);
}

float widened_gain(float own, float widened, float cosine) {
    const float bounded = std::max(cosine, 0.1f);
    return directional_albedo(glm::vec3(1), own, bounded).x /
           directional_albedo(glm::vec3(1), widened, bounded).x;
}

}  // namespace ir::passes
