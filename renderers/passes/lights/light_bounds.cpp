#include "renderers/passes/lights/light_bounds.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"

namespace ir::passes {
namespace {

float angle_of(float cosine) {
    return std::acos(std::clamp(cosine, -1.0f, 1.0f));
}

struct Cone {
    glm::vec3 axis;
    float cosine;
};

constexpr Cone all_around{{0, 1, 0}, -1};

/// `a` turned towards `b` by `angle`, given that they are not parallel.
glm::vec3 turned(glm::vec3 a, glm::vec3 b, float angle) {
    const auto sideways = glm::normalize(b - glm::dot(a, b) * a);
    return glm::normalize(std::cos(angle) * a + std::sin(angle) * sideways);
}

/// [Conty18 algorithm 1]
Cone merged(Cone a, Cone b) {
    if (a.cosine > b.cosine) std::swap(a, b);
    const float angle_a = angle_of(a.cosine), angle_b = angle_of(b.cosine);
    const float apart = angle_of(glm::dot(a.axis, b.axis));
    if (std::min(apart + angle_b, pi) <= angle_a) return a;
    const float angle = 0.5f * (angle_a + apart + angle_b);
    constexpr float nearly_opposite = pi - 1e-3f;
    if (angle >= nearly_opposite || apart >= nearly_opposite) return all_around;
    constexpr float nearly_equal = 1e-3f;
    if (apart < nearly_equal) return {a.axis, std::cos(angle_a + apart)};
    return {turned(a.axis, b.axis, angle - angle_a), std::cos(angle)};
}

}  // namespace

LightBounds merged(const LightBounds& a, const LightBounds& b) {
    if (!(a.intensity > 0)) return b;
    if (!(b.intensity > 0)) return a;
    const bool either = a.two_sided || b.two_sided;
    const auto b_axis = either && glm::dot(a.axis, b.axis) < 0 ? -b.axis : b.axis;
    const auto cone = merged(Cone{a.axis, a.cos_normals}, Cone{b_axis, b.cos_normals});
    return {glm::min(a.min, b.min),
            glm::max(a.max, b.max),
            cone.axis,
            cone.cosine,
            std::min(a.cos_emission, b.cos_emission),
            either,
            a.intensity + b.intensity};
}

float split_cost(const LightBounds& bounds) {
    const float normals = angle_of(bounds.cos_normals), emission = angle_of(bounds.cos_emission);
    const float reach = std::min(normals + emission, pi);
    const float sine = std::sqrt(std::max(1 - bounds.cos_normals * bounds.cos_normals, 0.0f));
    // M_Ω = 2π (1 - cos θo) + ∫ from θo to θw of cos(ω - θo) sin ω
    const float directions =
        2 * pi * (1 - bounds.cos_normals) +
        0.5f * pi *
            (2 * reach * sine - std::cos(normals - 2 * reach) - 2 * normals * sine + bounds.cos_normals);
    const auto d = bounds.max - bounds.min;
    const float area = 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
    return bounds.intensity * directions * area;
}

}  // namespace ir::passes
