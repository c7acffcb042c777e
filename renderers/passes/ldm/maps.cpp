#include "renderers/passes/ldm/maps.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ir::passes::ldm {
namespace {

/// Smallest side of a map's rectangle, and smallest depth range, as parts of the bounds' diagonal.
constexpr double min_side = 0.01, min_range = 0.25;

struct Interval {
    double min, max;
    double size() const { return max - min; }
    /// Widened about its middle to at least `size`.
    Interval at_least(double size) const {
        const double middle = 0.5 * (min + max), half = 0.5 * std::max(size, max - min);
        return {middle - half, middle + half};
    }
};

Interval extent_along(const scene::Bounds& bounds, const glm::dvec3& axis) {
    const glm::dvec3 centre = 0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max));
    const glm::dvec3 half = 0.5 * (glm::dvec3(bounds.max) - glm::dvec3(bounds.min));
    const double middle = glm::dot(centre, axis), reach = glm::dot(half, glm::abs(axis));
    return {middle - reach, middle + reach};
}

/// Coefficients that map `interval` along `axis` to [begin, end].
glm::dvec4 scale_to(const glm::dvec3& axis, const Interval& interval, double begin, double end) {
    const double scale = (end - begin) / interval.size();
    return {axis * scale, begin - interval.min * scale};
}

}  // namespace

MapFrame fit_frame(const glm::dvec3& direction, const scene::Bounds& bounds, int resolution) {
    // At least what float resolves at that distance from the origin.
    const double diagonal = std::max({2.0 * bounds.radius(), 0.1 * glm::length(bounds.centre()), 1e-6});
    // Each side of the projected box is parallel to a projected axis, and a smallest enclosing rectangle has
    // a side along one of the hull's. [Freeman75]
    glm::dvec3 axis_u{}, axis_v{};
    Interval range_u{}, range_v{};
    double smallest = 0;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 axis{0};
        axis[i] = 1;
        glm::dvec3 u = axis - direction * glm::dot(axis, direction);
        if (glm::length(u) < 1e-3) continue;
        u = glm::normalize(u);
        const glm::dvec3 v = glm::cross(direction, u);
        const auto along_u = extent_along(bounds, u).at_least(min_side * diagonal);
        const auto along_v = extent_along(bounds, v).at_least(min_side * diagonal);
        const double area = along_u.size() * along_v.size();
        if (smallest > 0 && area >= smallest) continue;
        smallest = area;
        axis_u = u, axis_v = v, range_u = along_u, range_v = along_v;
    }
    const auto range = extent_along(bounds, direction).at_least(min_range * diagonal);
    MapFrame frame;
    frame.u = scale_to(axis_u, range_u, 0, resolution);
    frame.v = scale_to(axis_v, range_v, 0, resolution);
    frame.depth = scale_to(direction, range, depth_margin, max_depth - depth_margin);
    frame.step_u = glm::dvec4(axis_u * (range_u.size() / resolution), 0);
    frame.step_v = glm::dvec4(axis_v * (range_v.size() / resolution), 0);
    frame.direction = glm::dvec4(direction, range.size() / (max_depth - 2 * depth_margin));
    return frame;
}

std::vector<MapFrame> fit_frames(const std::vector<Direction>& directions, const glm::dmat3& rotation,
                                 const scene::Bounds& bounds, int resolution) {
    std::vector<MapFrame> frames;
    frames.reserve(directions.size());
    for (const auto& direction : directions)
        frames.push_back(fit_frame(glm::normalize(rotation * direction.centre), bounds, resolution));
    return frames;
}

glm::dvec3 texel_centre_ws(const MapFrame& frame, int column, int row, double depth) {
    const glm::dvec3 u(frame.step_u), v(frame.step_v),
        d(glm::dvec3(frame.direction) * double(frame.direction.w));
    return u * (column + 0.5 - frame.u.w) + v * (row + 0.5 - frame.v.w) + d * (depth - frame.depth.w);
}

}  // namespace ir::passes::ldm
