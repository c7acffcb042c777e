#pragma once

#include <glm/glm.hpp>

namespace ir::passes {

/// Where a group of lights is, and where it shines: a box, and a cone of normals (half-angle θo) around which
/// light spreads by θe more.  [Conty18 §4.1]
struct LightBounds {
    glm::vec3 min{0}, max{0};
    glm::vec3 axis{0, 1, 0};
    float cos_normals = -1;  ///< cos θo
    float cos_emission = 0;  ///< cos θe, at least 0
    bool two_sided = false;  ///< the cone stands for its mirror image too
    float intensity = 0;     ///< W/sr along the normal, luminance; 0: nothing is there

    float half_diagonal() const { return 0.5f * glm::length(max - min); }
};

/// The smallest bounds of that form (nearly) which hold both.  [Conty18 algorithm 1]
LightBounds merged(const LightBounds& a, const LightBounds& b);

/// Probability that a random ray meets the box, times the directions lit, times the intensity: what a split
/// of a group should make small.  [Conty18 §4.4]
float split_cost(const LightBounds& bounds);

}  // namespace ir::passes
