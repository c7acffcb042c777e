// Arched openings and groin vaults.

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/architecture.h"

namespace ir::scene::builtin {
namespace {

/// Angles from 0 to 180° that include those of the panel's upper corners, so that no strip cuts a corner.
std::vector<float> arch_angles(float corner, int segments) {
    std::vector<float> angles;
    const auto add_span = [&](float from, float to) {
        const int count = std::max(1, static_cast<int>(std::lround(segments * (to - from) / pi)));
        for (int i = 0; i < count; ++i) angles.push_back(from + (to - from) * i / count);
    };
    add_span(0, corner);
    add_span(corner, pi - corner);
    add_span(pi - corner, pi);
    angles.push_back(pi);
    return angles;
}

struct ArchPoints {
    std::vector<glm::vec2> inner, outer;  ///< on the opening and, radially outwards, on the panel's border
};

ArchPoints arch_points(const ArchedPanel& p, int segments) {
    const float half = p.width / 2, high = p.top - p.spring;
    ArchPoints points;
    for (const float angle : arch_angles(std::atan2(high, half), segments)) {
        const glm::vec2 direction(std::cos(angle), std::sin(angle));
        const float to_side = half / std::max(std::abs(direction.x), 1e-6f);
        const float to_top = high / std::max(direction.y, 1e-6f);
        const glm::vec2 centre(0, p.spring);
        points.inner.push_back(centre + p.radius * direction);
        points.outer.push_back(centre + std::min(to_side, to_top) * direction);
    }
    return points;
}

/// One face of the panel; texture coordinates are x and y.
void add_face(MeshBuilder& b, const ArchedPanel& p, const ArchPoints& arch, float z, bool is_front) {
    const glm::vec3 normal(0, 0, is_front ? 1 : -1);
    const auto quad = [&](glm::vec2 a, glm::vec2 c, glm::vec2 d, glm::vec2 e) {
        const glm::vec2 corners[4] = {a, c, d, e};
        b.grid(1, 1, [&](float u, float v) {
            const bool right = (u > 0.5f) == is_front;
            const glm::vec2 q = v < 0.5f ? corners[right ? 1 : 0] : corners[right ? 2 : 3];
            return Vertex{{q, z}, normal, q};
        });
    };
    const float half = p.width / 2, r = p.radius;
    for (std::size_t i = 0; i + 1 < arch.inner.size(); ++i)
        quad(arch.inner[i], arch.outer[i], arch.outer[i + 1], arch.inner[i + 1]);
    if (p.spring > p.sill) {
        quad({-half, p.sill}, {-r, p.sill}, {-r, p.spring}, {-half, p.spring});
        quad({r, p.sill}, {half, p.sill}, {half, p.spring}, {r, p.spring});
    }
    if (p.sill > p.bottom) {
        const float x[4] = {-half, -r, r, half};
        for (int i = 0; i < 3; ++i)
            quad({x[i], p.bottom}, {x[i + 1], p.bottom}, {x[i + 1], p.sill}, {x[i], p.sill});
    }
}

void add_reveals(MeshBuilder& b, const ArchedPanel& p, const ArchPoints& arch) {
    const int count = static_cast<int>(arch.inner.size()) - 1;
    const float d = p.depth, r = p.radius, half = p.width / 2;
    b.grid(count, 1, [&](float u, float v) {
        const glm::vec2 q = arch.inner[std::lround(u * count)];
        const glm::vec2 inwards = (glm::vec2(0, p.spring) - q) / r;
        return Vertex{{q, -d * v}, {inwards, 0}, {pi * r * u, d * v}};
    });
    if (p.spring > p.sill) {
        b.quad({r, p.sill, 0}, {r, p.spring, 0}, {r, p.spring, -d}, {r, p.sill, -d});
        b.quad({-r, p.sill, -d}, {-r, p.spring, -d}, {-r, p.spring, 0}, {-r, p.sill, 0});
    }
    if (p.sill > p.bottom) {
        b.quad({-r, p.sill, 0}, {r, p.sill, 0}, {r, p.sill, -d}, {-r, p.sill, -d});
        b.quad({-half, p.bottom, -d}, {half, p.bottom, -d}, {half, p.bottom, 0}, {-half, p.bottom, 0});
    } else {
        b.quad({-half, p.bottom, -d}, {-r, p.bottom, -d}, {-r, p.bottom, 0}, {-half, p.bottom, 0});
        b.quad({r, p.bottom, -d}, {half, p.bottom, -d}, {half, p.bottom, 0}, {r, p.bottom, 0});
    }
    b.quad({-half, p.top, 0}, {half, p.top, 0}, {half, p.top, -d}, {-half, p.top, -d});
}

}  // namespace

void arched_panel(MeshBuilder& b, const ArchedPanel& panel, int segments) {
    const ArchPoints arch = arch_points(panel, segments);
    add_face(b, panel, arch, 0, true);
    if (panel.has_back) add_face(b, panel, arch, -panel.depth, false);
    add_reveals(b, panel, arch);
}

void groin_vault(MeshBuilder& b, glm::vec2 low, glm::vec2 high, float spring, float rise, int segments) {
    const glm::vec2 centre = 0.5f * (low + high), half = 0.5f * (high - low);
    // A web spans |across| ≤ outwards between the crown and one side of the rectangle.
    const auto add_web = [&](glm::vec2 outwards, glm::vec2 across) {
        b.grid(2 * segments, segments, [&](float u, float v) {
            const float t = std::sin(pi / 2 * v), s = std::sin(pi / 2 * (2 * u - 1)) * t;
            const glm::vec2 xz = centre + half * (t * outwards + s * across);
            const float height = rise * std::sqrt(std::max(0.0f, 1 - s * s));
            const glm::vec2 side = s / half * across;
            return Vertex{{xz.x, spring + height, xz.y},
                          {-side.x, -std::sqrt(std::max(0.0f, 1 - s * s)) / rise - 1e-6f, -side.y},
                          xz};
        });
    };
    add_web({0, 1}, {1, 0});
    add_web({0, -1}, {-1, 0});
    add_web({1, 0}, {0, -1});
    add_web({-1, 0}, {0, 1});
}

}  // namespace ir::scene::builtin
