#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace ir::passes {

/// Neighbours in a light tree, a plane for each of their numbers, so that vectors judge all of them at once.
struct LightGroup {
    static constexpr int capacity = 16;
    using Plane = std::array<float, capacity>;

    std::array<Plane, 3> centre{}, axis{};
    Plane squared_radius{}, intensity{}, cos_normals{}, sin_normals{}, cos_emission{};
    Plane two_sided{};  ///< 1 or 0
    int count = 0;
};

/// What each of a group may send to a point, and their sum; 0 beyond its count. `normal_ws` is the unit
/// normal of the point's plane or 0.
struct LightWeights {
    alignas(64) LightGroup::Plane of;
    float sum;
};
void weigh(const LightGroup& group, glm::vec3 position_ws, glm::vec3 normal_ws, LightWeights& weights);

/// Of each whether a ray along a unit direction may meet it, a bit; by its bounding sphere.
std::uint32_t may_meet(const LightGroup& group, glm::vec3 origin_ws, glm::vec3 direction_ws);

}  // namespace ir::passes
