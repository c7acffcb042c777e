#include "renderers/scene/builtin/plates.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace ir::scene::builtin {
namespace {

/// A side of the outline, with the normals to shade its ends with.
struct Side {
    glm::vec2 from, to, normal_from, normal_to;
    glm::vec2 inset_from, inset_to;
    float start, length;
};

std::vector<Side> sides_of(const Outline& o, float bevel) {
    const std::size_t n = o.size();
    std::vector<glm::vec2> normals(n), inset(n);
    for (std::size_t i = 0; i < n; ++i) {
        const glm::vec2 way = o[(i + 1) % n] - o[i];
        normals[i] = glm::normalize(glm::vec2(way.y, -way.x));
    }
    const auto shaded = [&](std::size_t i, std::size_t neighbour) {
        const bool is_smooth = glm::dot(normals[i], normals[neighbour]) > crease;
        return is_smooth ? glm::normalize(normals[i] + normals[neighbour]) : normals[i];
    };
    for (std::size_t i = 0; i < n; ++i) {
        const glm::vec2 before = normals[(i + n - 1) % n];
        inset[i] = o[i] - bevel * (before + normals[i]) / (1 + glm::dot(before, normals[i]));
    }
    std::vector<Side> sides;
    float start = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = (i + 1) % n;
        const float length = glm::distance(o[i], o[next]);
        sides.push_back({o[i], o[next], shaded(i, (i + n - 1) % n), shaded(i, next), inset[i], inset[next],
                         start, length});
        start += length;
    }
    return sides;
}

void add_side(MeshBuilder& b, const Plate& p, const Side& s, float high, float low, bool is_front) {
    // From the inset edge to the full one at the front, or the other way round at the back.
    const float slope = is_front ? 1.0f : -1.0f;
    b.grid(1, 1, [&](float u, float v) {
        const bool is_inset = (v > 0.5f) == is_front;
        const glm::vec2 full = u < 0.5f ? s.from : s.to, inset = u < 0.5f ? s.inset_from : s.inset_to;
        const glm::vec2 at = is_inset ? inset : full, normal = u < 0.5f ? s.normal_from : s.normal_to;
        const float z = v > 0.5f ? high : low;
        return Vertex{
            {at, z}, glm::normalize(glm::vec3(normal, slope)), p.uv + glm::vec2(s.start + u * s.length, z)};
    });
}

void add_rim(MeshBuilder& b, const Plate& p, const Side& s) {
    const float z[2] = {p.back + p.bevel, p.front - p.bevel};
    b.grid(1, 1, [&](float u, float v) {
        const float height = z[v > 0.5f];
        return Vertex{{u < 0.5f ? s.from : s.to, height},
                      {u < 0.5f ? s.normal_from : s.normal_to, 0},
                      p.uv + glm::vec2(s.start + u * s.length, height)};
    });
}

void add_faces(MeshBuilder& b, const Plate& p, const std::vector<Side>& sides) {
    const int count = static_cast<int>(sides.size());
    for (const bool is_front : {true, false}) {
        if (count == 4) {  // no need of a middle
            b.grid(1, 1, [&](float u, float v) {
                const int i = v < 0.5f ? (u < 0.5f ? 0 : 1) : (u < 0.5f ? 3 : 2);
                const glm::vec2 at = sides[is_front ? i : 3 - i].inset_from;
                return Vertex{{at, is_front ? p.front : p.back}, {0, 0, is_front ? 1 : -1}, p.uv + at};
            });
            continue;
        }
        b.grid(count, 1, [&](float u, float v) {
            const int i = static_cast<int>(std::lround(u * count)) % count;
            const bool is_middle = (v > 0.5f) == is_front;
            const glm::vec2 at = is_middle ? p.middle : sides[i].inset_from;
            return Vertex{{at, is_front ? p.front : p.back}, {0, 0, is_front ? 1 : -1}, p.uv + at};
        });
    }
}

glm::vec2 mean_of(const Profile& profile) {
    glm::vec2 sum{0};
    for (const auto& p : profile) sum += p;
    return sum / static_cast<float>(profile.size());
}

/// A fan over the profile in a frame, facing along `normal`.
void add_cap(MeshBuilder& b, const Profile& profile, const Frame& f, glm::vec3 normal) {
    const int count = static_cast<int>(profile.size());
    const glm::vec2 middle = mean_of(profile);
    const bool is_turned = glm::dot(glm::cross(f.x, f.y), normal) < 0;
    b.grid(count, 1, [&](float u, float v) {
        const int i = static_cast<int>(std::lround(u * count)) % count;
        const glm::vec2 p = (v > 0.5f) == is_turned ? profile[i] : middle;
        return Vertex{f.origin + p.x * f.x + p.y * f.y, normal, p};
    });
}

Profile closed(const Profile& profile) {
    Profile loop = profile;
    loop.push_back(profile.front());
    return loop;
}

glm::mat4 laid_down() {
    return glm::mat4(glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, -1, 0), glm::vec4(0, 1, 0, 0),
                     glm::vec4(0, 0, 0, 1));
}

}  // namespace

void plate(MeshBuilder& b, const Plate& p) {
    const auto sides = sides_of(p.outline, p.bevel);
    add_faces(b, p, sides);
    for (const auto& side : sides) {
        add_rim(b, p, side);
        if (p.bevel <= 0) continue;
        add_side(b, p, side, p.front, p.front - p.bevel, true);
        add_side(b, p, side, p.back + p.bevel, p.back, false);
    }
}

void lying_plate(MeshBuilder& b, const Plate& p) {
    const glm::mat4 before = b.transform;
    b.transform = before * laid_down();
    plate(b, p);
    b.transform = before;
}

Outline rectangle(glm::vec2 low, glm::vec2 high) {
    return {low, {high.x, low.y}, high, {low.x, high.y}};
}

void block(MeshBuilder& b, glm::vec3 min, glm::vec3 max, float bevel, glm::vec2 uv) {
    plate(b, {rectangle(min, max), min.z, max.z, bevel, 0.5f * glm::vec2(min + max), uv});
}

void lying_block(MeshBuilder& b, glm::vec3 min, glm::vec3 max, float bevel, glm::vec2 uv) {
    const glm::vec2 low(min.x, -max.z), high(max.x, -min.z);
    lying_plate(b, {rectangle(low, high), min.y, max.y, bevel, 0.5f * (low + high), uv});
}

void limb(MeshBuilder& b, std::span<const glm::vec3> way, std::span<const float> radii, int around) {
    const int last = static_cast<int>(way.size()) - 1;
    std::vector<Frame> frames;  // origin, and the two directions across
    std::vector<float> distances{0};
    glm::vec3 along = glm::normalize(way[1] - way[0]);
    glm::vec3 x =
        glm::normalize(glm::cross(along, std::abs(along.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    for (int i = 0; i <= last; ++i) {
        along = glm::normalize(way[std::min(i + 1, last)] - way[std::max(i - 1, 0)]);
        x = glm::normalize(x - glm::dot(x, along) * along);
        frames.push_back({way[i], x, glm::cross(along, x)});
        if (i > 0) distances.push_back(distances.back() + glm::distance(way[i], way[i - 1]));
    }
    const int rows = last + 2;
    b.grid(around, rows, [&](float u, float v) {
        const int row = static_cast<int>(std::lround(v * rows)), i = std::clamp(row - 1, 0, last);
        const int column = static_cast<int>(std::lround(u * around)) % around;
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(column) / around;
        const Frame& f = frames[i];
        const glm::vec3 out = std::cos(angle) * f.x + std::sin(angle) * f.y;
        const glm::vec2 uv(u * 6.28f * radii[0], distances[i]);
        if (row == 0) return Vertex{f.origin, -glm::cross(f.x, f.y), uv};
        if (row == rows) return Vertex{f.origin, glm::cross(f.x, f.y), uv};
        return Vertex{f.origin + radii[i] * out, out, uv};
    });
}

void moulding(MeshBuilder& b, Profile profile, const std::vector<Frame>& frames) {
    sweep(b, closed(profile), frames);
    const glm::vec2 middle = mean_of(profile);
    const auto at = [&](const Frame& f) { return f.origin + middle.x * f.x + middle.y * f.y; };
    const std::size_t n = frames.size();
    const auto normal = [&](const Frame& f, glm::vec3 outwards) {
        const glm::vec3 axis = glm::normalize(glm::cross(f.x, f.y));
        return glm::dot(axis, outwards) < 0 ? -axis : axis;
    };
    add_cap(b, profile, frames[0], normal(frames[0], at(frames[0]) - at(frames[1])));
    add_cap(b, profile, frames[n - 1], normal(frames[n - 1], at(frames[n - 1]) - at(frames[n - 2])));
}

void round_moulding(MeshBuilder& b, Profile profile, const std::vector<Frame>& frames) {
    sweep(b, closed(profile), frames);
}

}  // namespace ir::scene::builtin
