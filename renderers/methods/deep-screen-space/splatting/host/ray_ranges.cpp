#include "renderers/methods/deep-screen-space/splatting/host/ray_ranges.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"

namespace ir::methods::deep_screen_space {
namespace {

constexpr float rounding = 1e-4f;

}  // namespace

RayRanges::RayRanges(const scene::View& view, const VisibleLevel& rules, std::span<const Surfel> surfels,
                     const Parameters& parameters)
    : ideal_(ideal(view, parameters)),
      rules_(rules),
      shells_per_radius_(rules.influence.trade_off > 0 ? 1 / std::sqrt(rules.influence.trade_off) : 0) {
    for (const auto& s : surfels) {
        if (s.radius == 0) continue;
        const float part = s.radius / ideal_scale(ideal_, ideal_distance(ideal_, s.centre_ws));
        least_ = std::min(least_, part);
        most_ = std::max(most_, part);
        largest_ = std::max(largest_, s.radius);
    }
}

/// The largest t with t ≤ beyond + factor · distance(x + t direction).
float RayRanges::last(float beyond, float factor, glm::vec3 x_ws, glm::vec3 direction_ws) const {
    if (is_parallel(ideal_)) return beyond + factor;
    const auto offset = x_ws - ideal_.ideal_eye_ws;
    const auto solve = [&](float at_x, float slope) {
        return factor * slope < 1 ? (beyond + factor * at_x) / (1 - factor * slope) : infinity;
    };
    return std::max(
        {solve(glm::dot(offset, ideal_.ideal_axis_ws), glm::dot(direction_ws, ideal_.ideal_axis_ws)),
         solve(ideal_.ideal_corner_cosine * glm::length(offset), ideal_.ideal_corner_cosine),
         solve(ideal_.ideal_nearest, 0)});
}

/// No t below it has t ≥ factor · distance(x + t direction).
float RayRanges::first(float factor, glm::vec3 x_ws, glm::vec3 direction_ws) const {
    if (is_parallel(ideal_)) return factor;
    const auto offset = x_ws - ideal_.ideal_eye_ws;
    const float size = glm::length(offset);
    const auto solve = [&](float at_x, float slope) {
        if (at_x <= 0) return 0.0f;
        return factor * slope < 1 ? factor * at_x / (1 - factor * slope) : infinity;
    };
    // The length is at least that along the way from the eye to x.
    const float away = size > 0 ? glm::dot(direction_ws, offset) / size : 0;
    return std::max(
        {solve(glm::dot(offset, ideal_.ideal_axis_ws), glm::dot(direction_ws, ideal_.ideal_axis_ws)),
         solve(ideal_.ideal_corner_cosine * size, ideal_.ideal_corner_cosine * away),
         solve(ideal_.ideal_nearest, 0)});
}

float RayRanges::exact_reach(glm::vec3 x_ws) const {
    const float radius = ideal_.ideal_radius * ideal_scale(ideal_, ideal_distance(ideal_, x_ws));
    const float reach = shell_of(rules_.influence, radius, 0).outer;
    return rules_.max_distance > 0 ? std::min(reach, rules_.max_distance) : reach;
}

RayRanges::Range RayRanges::of(int level, glm::vec3 x_ws, glm::vec3 direction_ws) const {
    const auto& i = rules_.influence;
    const float disc = splat_disc_radius(rules_, level, 1);  // radii of a surfel
    Range range;
    range.far = rules_.max_distance > 0 ? rules_.max_distance : i.whole_reach + disc * largest_;
    // How much farther from the eye than a point of the disc its centre may be.
    const float apart = is_parallel(ideal_) ? 0 : disc * most_;
    if (level != i.open_level && apart < 1) {
        const float size = disc * most_ / (1 - apart);
        const float shell = std::ldexp(shells_per_radius_, level) * most_ / (1 - apart);
        range.far =
            std::min(range.far, std::max(last(0, shell + size, x_ws, direction_ws),
                                         last(std::ldexp(i.shell_radius, level), size, x_ws, direction_ws)));
    }
    range.far *= 1 + rounding;
    // Of the shells that count the nearest one, k, begins at 2^(k-1) / √ε radii, and its discs are 2^k times
    // as large. Farther out both are larger.
    const int shell = rules_.full_discs ? 1 : level;
    const float clear = std::ldexp(shells_per_radius_ - 2 * splat_disc_radius(rules_, 0, 1), shell - 1);
    if (level == 0 || clear <= 0) return range;
    range.near = (1 - rounding) * first(clear * least_ / (1 + apart), x_ws, direction_ws);
    return range;
}

}  // namespace ir::methods::deep_screen_space
