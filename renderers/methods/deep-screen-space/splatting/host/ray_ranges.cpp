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
    for (int number = 0; number < max_levels; ++number)
        levels_[static_cast<std::size_t>(number)] = level(number);
}

RayRanges::Level RayRanges::level(int number) const {
    const auto& i = rules_.influence;
    const float disc = splat_disc_radius(rules_, number, 1);  // radii of a surfel
    Level level{.far_m = rules_.max_distance > 0 ? rules_.max_distance : i.whole_reach + disc * largest_};
    // How much farther from the eye than a point of the disc its centre may be.
    const float apart = is_parallel(ideal_) ? 0 : disc * most_;
    if (number != i.open_level && apart < 1) {
        level.ends = true;
        level.size = disc * most_ / (1 - apart);
        level.shell = std::ldexp(shells_per_radius_, number) * most_ / (1 - apart);
        level.shell_radius_m = std::ldexp(i.shell_radius, number);
    }
    // Of the shells that count the nearest one, k, begins at 2^(k-1) / √ε radii, and its discs are 2^k times
    // as large. Farther out both are larger.
    const int shell = rules_.full_discs ? 1 : number;
    const float clear = std::ldexp(shells_per_radius_ - 2 * splat_disc_radius(rules_, 0, 1), shell - 1);
    if (number > 0 && clear > 0) level.near = clear * least_ / (1 + apart);
    return level;
}

RayRanges::Start RayRanges::start(glm::vec3 x_ws) const {
    const auto offset = x_ws - ideal_.ideal_eye_ws;
    const float size = glm::length(offset);
    const float reach =
        shell_of(rules_.influence, ideal_.ideal_radius * ideal_scale(ideal_, ideal_distance(ideal_, x_ws)), 0)
            .outer;
    return {.along = glm::dot(offset, ideal_.ideal_axis_ws),
            .size = size,
            .away = size > 0 ? offset / size : glm::vec3(0),
            .exact_reach = rules_.max_distance > 0 ? std::min(reach, rules_.max_distance) : reach};
}

/// The largest t with t ≤ beyond + factor · distance(x + t direction). `slope`: of the direction along the
/// axis of view.
float RayRanges::last(float beyond_m, float factor, const Start& start, float slope) const {
    if (is_parallel(ideal_)) return beyond_m + factor;
    const auto solve = [&](float at_x, float part) {
        return factor * part < 1 ? (beyond_m + factor * at_x) / (1 - factor * part) : infinity;
    };
    return std::max({solve(start.along, slope),
                     solve(ideal_.ideal_corner_cosine * start.size, ideal_.ideal_corner_cosine),
                     solve(ideal_.ideal_nearest, 0)});
}

/// No t below it has t ≥ factor · distance(x + t direction).
float RayRanges::first(float factor, const Start& start, glm::vec3 direction_ws) const {
    if (is_parallel(ideal_)) return factor;
    const auto solve = [&](float at_x, float slope) {
        if (at_x <= 0) return 0.0f;
        return factor * slope < 1 ? factor * at_x / (1 - factor * slope) : infinity;
    };
    // The length is at least that along the way from the eye to x.
    return std::max({solve(start.along, glm::dot(direction_ws, ideal_.ideal_axis_ws)),
                     solve(ideal_.ideal_corner_cosine * start.size,
                           ideal_.ideal_corner_cosine * glm::dot(direction_ws, start.away)),
                     solve(ideal_.ideal_nearest, 0)});
}

RayRanges::Range RayRanges::of(int number, const Start& start, glm::vec3 direction_ws) const {
    const auto& level = levels_[static_cast<std::size_t>(number)];
    Range range{.far = level.far_m};
    if (level.ends) {
        const float slope = glm::dot(direction_ws, ideal_.ideal_axis_ws);
        float end = last(0, level.shell + level.size, start, slope);
        if (level.shell_radius_m > 0)
            end = std::max(end, last(level.shell_radius_m, level.size, start, slope));
        range.far = std::min(range.far, end);
    }
    range.far *= 1 + rounding;
    if (level.near > 0) range.near = (1 - rounding) * first(level.near, start, direction_ws);
    return range;
}

}  // namespace ir::methods::deep_screen_space
