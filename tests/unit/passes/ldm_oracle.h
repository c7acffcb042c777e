#pragma once

#include <algorithm>
#include <cmath>

#include "ldm_fixture.h"

namespace ir::passes::ldm {

/// Scan conversion on the host, one texel centre after another, in 64-bit integers.
inline Lists scan_convert(const scene::World& world, const std::vector<MapFrame>& frames, int resolution) {
    Lists result(frames.size() * resolution * resolution);
    using Point = glm::vec<2, std::int64_t>;
    const auto cross = [](Point a, Point b) { return a.x * b.y - a.y * b.x; };
    for (std::size_t map = 0; map < frames.size(); ++map) {
        const auto& f = frames[map];
        for (std::size_t triangle = 0; triangle < world.triangles(); ++triangle) {
            Point p[3];
            double depth[3];
            for (int i = 0; i < 3; ++i) {
                const auto& v = world.positions[world.indices[3 * triangle + i]];
                const auto snapped = [&](const glm::vec4& row) {
                    return static_cast<std::int64_t>(
                        std::floor((glm::dot(v, glm::vec3(row)) + row.w) * subtexels + 0.5f));
                };
                p[i] = {snapped(f.u), snapped(f.v)};
                depth[i] = glm::dot(v, glm::vec3(f.depth)) + f.depth.w;
            }
            auto area = cross(p[1] - p[0], p[2] - p[0]);
            if (area == 0) continue;
            if (area < 0) std::swap(p[1], p[2]), std::swap(depth[1], depth[2]), area = -area;
            const auto texel = [](std::int64_t s) {
                return static_cast<int>(std::floor(s / double(subtexels)));
            };
            const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
            const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
            for (int y = std::max(0, texel(top)); y <= std::min(resolution - 1, texel(bottom)); ++y)
                for (int x = std::max(0, texel(left)); x <= std::min(resolution - 1, texel(right)); ++x) {
                    const Point centre{x * subtexels + subtexels / 2, y * subtexels + subtexels / 2};
                    double sum = 0;
                    bool inside = true;
                    for (int i = 0; i < 3; ++i) {
                        const auto &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
                        const auto weight = cross(b - a, centre - a);
                        const bool owns_ties = b.y < a.y || (b.y == a.y && b.x > a.x);
                        inside = inside && (weight > 0 || (weight == 0 && owns_ties));
                        sum += static_cast<double>(weight) / static_cast<double>(area) * depth[i];
                    }
                    if (inside)
                        result[(map * resolution + y) * resolution + x].push_back(
                            static_cast<std::uint16_t>(std::clamp(std::floor(sum + 0.5), 1.0, 65534.0)));
                }
        }
    }
    for (auto& list : result) std::sort(list.begin(), list.end());
    return result;
}

}  // namespace ir::passes::ldm
