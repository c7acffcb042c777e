#include "renderers/scene/builtin/architecture.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"

namespace ir::scene::builtin {
namespace {

struct ProfilePoint {
    glm::vec2 position, normal;
    float distance;  ///< along the profile
};

glm::vec2 right_of(glm::vec2 way) {
    return glm::normalize(glm::vec2(way.y, -way.x));
}

/// Splits a profile at its creases.
std::vector<std::vector<ProfilePoint>> smooth_runs(const Profile& p) {
    std::vector<std::vector<ProfilePoint>> runs;
    float distance = 0;
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        const glm::vec2 normal = right_of(p[i + 1] - p[i]);
        const bool is_smooth = i > 0 && glm::dot(normal, right_of(p[i] - p[i - 1])) > crease;
        if (!is_smooth)
            runs.push_back({{p[i], normal, distance}});
        else
            runs.back().back().normal = glm::normalize(normal + right_of(p[i] - p[i - 1]));
        distance += glm::length(p[i + 1] - p[i]);
        runs.back().push_back({p[i + 1], normal, distance});
    }
    return runs;
}

glm::vec3 point_in(const Frame& frame, glm::vec2 p) {
    return frame.origin + p.x * frame.x + p.y * frame.y;
}

}  // namespace

void add_arc(Profile& profile, glm::vec2 centre, float radius, float from, float to, int segments) {
    for (int i = 0; i <= segments; ++i) {
        const float angle = glm::radians(from + (to - from) * i / segments);
        profile.push_back(centre + radius * glm::vec2(std::cos(angle), std::sin(angle)));
    }
}

void sweep(MeshBuilder& b, const Profile& profile, std::vector<Frame> frames) {
    glm::vec2 middle{0};
    for (const auto& p : profile) middle += p / float(profile.size());
    const Frame& first = frames.front();
    const glm::vec3 along = point_in(frames[1], middle) - point_in(first, middle);
    if (glm::dot(glm::cross(along, first.y), first.x) < 0) std::reverse(frames.begin(), frames.end());
    std::vector<float> lengths(frames.size(), 0);
    for (std::size_t i = 1; i < frames.size(); ++i)
        lengths[i] =
            lengths[i - 1] + glm::distance(point_in(frames[i], middle), point_in(frames[i - 1], middle));
    const int columns = static_cast<int>(frames.size()) - 1;
    for (const auto& run : smooth_runs(profile)) {
        const int rows = static_cast<int>(run.size()) - 1;
        b.grid(columns, rows, [&](float u, float v) {
            const int i = static_cast<int>(std::lround(u * columns));
            const auto& p = run[std::lround(v * rows)];
            const Frame& frame = frames[i];
            return Vertex{point_in(frame, p.position),
                          p.normal.x * frame.x + p.normal.y * frame.y,
                          {lengths[i], p.distance}};
        });
    }
}

std::vector<Frame> arc_frames(glm::vec3 centre, glm::vec3 x, glm::vec3 y, float from, float to,
                              int segments) {
    const glm::vec3 z = glm::cross(x, y);
    std::vector<Frame> frames;
    for (int i = 0; i <= segments; ++i) {
        const float angle = glm::radians(from + (to - from) * i / segments);
        frames.push_back({centre, std::cos(angle) * x + std::sin(angle) * z, y});
    }
    return frames;
}

void lathe(MeshBuilder& b, glm::vec3 centre, const Profile& profile, int segments) {
    auto frames = arc_frames(centre, {1, 0, 0}, {0, 1, 0}, 0, -360, segments);
    frames.back() = frames.front();  // closed to the last bit
    Profile clean = profile;
    for (auto& p : clean)
        if (p.x < 1e-6f) p.x = 0;  // arcs that end on the axis
    sweep(b, clean, frames);
}

void ring(MeshBuilder& b, const Ring& r) {
    const glm::vec2 signs[4] = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}};
    for (int i = 0; i < 4; ++i) {
        const glm::vec2 s = signs[i], t = signs[(i + 1) % 4];
        const auto at = [](glm::vec2 sign, glm::vec2 half, float y) {
            return glm::vec3(sign.x * half.x, y, sign.y * half.y);
        };
        const float along = i % 2 ? r.outer.x : r.outer.y;  // texture coordinates centred on the side
        b.quad(at(s, r.outer, r.outer_bottom), at(t, r.outer, r.outer_bottom), at(t, r.outer, r.outer_top),
               at(s, r.outer, r.outer_top), {-along, r.outer_bottom});
        b.quad(at(t, r.inner, r.inner_bottom), at(s, r.inner, r.inner_bottom), at(s, r.inner, r.inner_top),
               at(t, r.inner, r.inner_top), {-along, r.inner_bottom});
        b.quad(at(s, r.outer, r.outer_top), at(t, r.outer, r.outer_top), at(t, r.inner, r.inner_top),
               at(s, r.inner, r.inner_top), {-along, 0});
        b.quad(at(t, r.outer, r.outer_bottom), at(s, r.outer, r.outer_bottom), at(s, r.inner, r.inner_bottom),
               at(t, r.inner, r.inner_bottom), {-along, 0});
    }
}

void inner_moulding(MeshBuilder& b, glm::vec2 half, const Profile& profile) {
    const glm::vec2 signs[4] = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}};
    for (int i = 0; i < 4; ++i) {
        const glm::vec2 s = signs[i], t = signs[(i + 1) % 4], out = 0.5f * (s + t);
        const glm::vec3 inwards{-out.x, 0, -out.y};
        for (const auto& run : smooth_runs(profile)) {
            const int rows = static_cast<int>(run.size()) - 1;
            b.grid(1, rows, [&](float u, float v) {
                const auto& p = run[std::lround(v * rows)];
                const glm::vec2 sign = u < 0.5f ? t : s, xz = sign * (half - p.position.x);
                return Vertex{{xz.x, p.position.y, xz.y},
                              p.normal.x * inwards + p.normal.y * glm::vec3(0, 1, 0),
                              {u * 2 * (i % 2 ? half.x : half.y), p.distance}};
            });
        }
    }
}

void rib(MeshBuilder& b, float span, float spring, float rise, float width, float depth, int segments) {
    const float half = span / 2;
    const auto at = [&](float u, float inset, float x) {
        const float angle = pi * u;
        return glm::vec3(x, spring + (rise - inset) * std::sin(angle),
                         half - (half - inset) * std::cos(angle));
    };
    const auto down = [&](float u) {
        return glm::vec3(0, -std::sin(pi * u) / (rise - depth), std::cos(pi * u) / (half - depth));
    };
    const float w = width / 2;
    b.grid(segments, 1, [&](float u, float v) {
        const float x = v < 0.5f ? w : -w;
        return Vertex{at(u, depth, x), down(u), {u * span * 1.3f, x}};
    });
    for (const float side : {-1.0f, 1.0f})
        b.grid(segments, 1, [&](float u, float v) {
            const bool is_inner = (v < 0.5f) == (side < 0);
            return Vertex{at(u, is_inner ? depth : 0, side * w), {side, 0, 0}, {u * span * 1.3f, v * depth}};
        });
}

void rod(MeshBuilder& b, glm::vec3 a, glm::vec3 c, float radius, int segments) {
    const glm::vec3 axis = glm::normalize(c - a);
    const glm::vec3 side = std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 x = glm::normalize(glm::cross(side, axis));
    auto frames = arc_frames(a, x, axis, 0, -360, segments);
    frames.back() = frames.front();
    sweep(b, {{radius, 0}, {radius, glm::distance(a, c)}}, frames);
}

}  // namespace ir::scene::builtin
