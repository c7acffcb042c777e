#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>

#include "renderers/scene/world.h"

namespace ir::passes {

/// Unit normal of a triangle by its winding, 0 where it has no area: shaders/lib/triangle_plane.glsl on the
/// host. The cross product of the two shortest edges loses the fewest bits on slivers; lengths are scaled
/// first so that tiny triangles do not underflow.
inline glm::vec3 triangle_normal(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const auto ab = b - a, bc = c - b, ca = a - c;
    const float ab2 = glm::dot(ab, ab), bc2 = glm::dot(bc, bc), ca2 = glm::dot(ca, ca);
    const float longest = std::sqrt(std::max({ab2, bc2, ca2}));
    if (!(longest > 1e-30f)) return glm::vec3(0);  // the squares underflow
    const auto& first = ab2 >= bc2 && ab2 >= ca2 ? bc : ca2 >= bc2 ? ab : ca;
    const auto& second = ab2 >= bc2 && ab2 >= ca2 ? ca : ca2 >= bc2 ? bc : ab;
    const auto normal = glm::cross(first * (1 / longest), second * (1 / longest));
    const float size = glm::length(normal);
    return size > 0 ? normal / size : glm::vec3(0);
}

/// In the order of its winding.
inline std::array<glm::vec3, 3> triangle_corners(const scene::World& world, std::size_t triangle) {
    const auto corner = [&](std::size_t i) { return world.positions[world.indices[3 * triangle + i]]; };
    return {corner(0), corner(1), corner(2)};
}

/// As above, of a triangle of the world.
inline glm::vec3 triangle_normal(const scene::World& world, std::size_t triangle) {
    const auto corners = triangle_corners(world, triangle);
    return triangle_normal(corners[0], corners[1], corners[2]);
}

}  // namespace ir::passes
