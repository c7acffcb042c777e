// The apse, five sides of a decagon under a ribbed half dome, and the west front with portal and rose window.

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/cathedral.h"
#include "renderers/scene/builtin/plates.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin::cathedral_parts {
namespace {

constexpr int apse_sides = 5;
const glm::vec3 apse_centre{nave_end, 0, 0};

/// A corner of the apse's inner face; 0 and apse_sides lie in the nave's walls.
glm::vec3 apse_corner(int i) {
    const float angle = pi * (static_cast<float>(i) / apse_sides - 0.5f);
    const float c = i == 0 || i == apse_sides ? 0 : std::cos(angle);
    return apse_centre + nave * glm::vec3(c, 0, std::sin(angle));
}

/// x along the side's inner face from its middle, z into the apse.
glm::mat4 apse_side(int i) {
    const glm::vec3 from = apse_corner(i), to = apse_corner(i + 1);
    const glm::vec3 x = glm::normalize(to - from), z = glm::cross(x, glm::vec3(0, 1, 0));
    return glm::mat4(glm::vec4(x, 0), glm::vec4(0, 1, 0, 0), glm::vec4(z, 0),
                     glm::vec4(0.5f * (from + to), 1));
}

void add_apse_walls(MeshBuilder& wall, MeshBuilder& trim, const Detail& detail) {
    const float width = 2 * nave * std::sin(pi / (2 * apse_sides)), depth = 0.8f;
    for (int i = 0; i < apse_sides; ++i) {
        wall.transform = trim.transform = apse_side(i);
        arched_panel(wall, {width, -0.05f, vault_top, 3.6f, 8.3f, 0.72f, depth}, detail.segments(16, 8));
        for (int k = 0; k < 2; ++k) {  // a blind arcade
            const float x = (static_cast<float>(k) - 0.5f) * 1.12f;
            const glm::mat4 side = wall.transform;
            wall.transform = glm::translate(side, {x, 0, 0.14f});
            arched_panel(wall, {1.12f, 0.9f, 2.75f, 0.9f, 1.95f, 0.42f, 0.15f}, detail.segments(10, 5));
            wall.transform = side;
        }
        for (const float s : {-1.0f, 1.0f})
            wall.box({s * 1.12f - 0.06f, 0.88f, -0.02f}, {s * 1.12f + 0.06f, 2.8f, 0.17f});
        const Profile course{{-0.05f, -0.1f}, {0.06f, -0.1f}, {0.08f, -0.03f},
                             {0.18f, 0.02f},  {0.18f, 0.08f}, {-0.05f, 0.12f}};
        for (const float y : {2.85f, vault_spring - 0.15f})
            moulding(trim, course,
                     {{{-0.5f * width, y, 0}, {0, 0, 1}, {0, 1, 0}},
                      {{0.5f * width, y, 0}, {0, 0, 1}, {0, 1, 0}}});
        // The window's bars.
        block(trim, {-0.05f, 3.58f, -0.5f}, {0.05f, 8.9f, -0.4f}, 0.015f);
        for (const float y : {4.8f, 6.0f, 7.2f, 8.3f})
            trim.beam({-0.74f, y, -0.45f}, {0.74f, y, -0.45f}, 0.06f, 0.06f);
    }
    wall.transform = trim.transform = glm::mat4(1);
    for (int i = 0; i <= apse_sides; ++i) {
        const glm::vec3 corner = apse_corner(i), out = glm::normalize(corner - apse_centre);
        // Buttresses close the wedge between two sides.
        wall.beam(corner + 0.25f * out - glm::vec3(0, 0.05f, 0),
                  corner + 0.25f * out + glm::vec3(0, vault_top - 0.3f, 0), 0.42f, 0.42f, out);
        wall.beam(corner + 0.8f * out - glm::vec3(0, 0.05f, 0),
                  corner + 0.8f * out + glm::vec3(0, vault_top - 1.2f, 0), 0.6f, 1.3f, out);
        lathe(trim, corner - 0.04f * out,
              {{0, 0.7f},
               {0.2f, 0.7f},
               {0.2f, 0.95f},
               {0.15f, 1.05f},
               {0.16f, 1.12f},
               {0.1f, 1.2f},
               {0.1f, 9.1f},
               {0.14f, 9.15f},
               {0.1f, 9.2f},
               {0.12f, 9.35f},
               {0.22f, 9.5f},
               {0.22f, 9.62f},
               {0, 9.62f}},
              detail.segments(10, 6));
    }
}

/// The half dome as a closed body: webs below, a flat top, and upright sides.
void add_dome(MeshBuilder& b, int columns, int rows) {
    const auto point = [&](int i, float u, float v) {
        const glm::vec3 edge = glm::mix(apse_corner(i), apse_corner(i + 1), u) - apse_centre;
        const float rise = v == 1 ? 1 : std::sin(0.5f * pi * v), reach = v == 1 ? 0 : std::cos(0.5f * pi * v);
        return apse_centre + reach * edge + glm::vec3(0, vault_spring + vault_rise * rise, 0);
    };
    for (int i = 0; i < apse_sides; ++i) {
        const glm::vec3 side = apse_corner(i + 1) - apse_corner(i);
        const glm::vec3 out = glm::normalize(glm::cross(glm::vec3(0, 1, 0), side));
        const float apothem = glm::dot(apse_corner(i) - apse_centre, out);
        b.grid(columns, rows, [&](float u, float v) {
            const float angle = 0.5f * pi * v;
            const glm::vec3 normal = -std::cos(angle) / apothem * out -
                                     (std::sin(angle) / vault_rise + 1e-6f) * glm::vec3(0, 1, 0);
            return Vertex{point(i, u, v), glm::normalize(normal), {u * 2.6f, v * 6}};
        });
        const auto upper = [](glm::vec3 p) { return glm::vec3(p.x, vault_top, p.z); };
        b.grid(columns, 1, [&](float u, float v) {
            const glm::vec3 p = point(i, 1 - u, 0);
            return Vertex{
                v > 0.5f ? upper(p) : p, -out * (glm::dot(out, p - apse_centre) > 0 ? -1.0f : 1.0f), {u, v}};
        });
        b.grid(columns, 1, [&](float u, float v) {
            return Vertex{upper(v > 0.5f ? apse_centre : point(i, 1 - u, 0)), {0, 1, 0}, {u, v}};
        });
    }
    for (const int side : {0, 1}) {  // towards the nave: fans around the upper corners, up to the middle
        const glm::vec3 corner = apse_corner(side ? apse_sides : 0), top(0, vault_top, 0);
        b.grid(1, rows + 1, [&](float u, float v) {
            const bool is_arch = (u > 0.5f) == (side == 0);
            const int row = static_cast<int>(std::lround(v * static_cast<float>(rows + 1)));
            glm::vec3 p = corner + top;
            if (is_arch)
                p = row > rows ? apse_centre + top
                               : point(side ? apse_sides - 1 : 0, static_cast<float>(side),
                                       static_cast<float>(row) / static_cast<float>(rows));
            return Vertex{p, {-1, 0, 0}, {p.z, p.y}};
        });
    }
}

void add_dome_ribs(MeshBuilder& b, const Detail& detail) {
    for (int i = 0; i <= apse_sides; ++i) {
        const glm::vec3 from = apse_corner(i) + glm::vec3(0, vault_spring, 0);
        const glm::vec3 to = 2.0f * (apse_centre + glm::vec3(0, vault_spring, 0)) - from;
        add_rib(b, {from, to, vault_rise, 0, 90}, 0.22f, detail.segments(10, 5));
    }
    ball(b, apse_centre + glm::vec3(0, vault_spring + vault_rise - 0.1f, 0), 0.33f, detail.segments(16, 8));
}

// --- West -----------------------------------------------------------------------------------------------

/// A square wall in the plane of x and y around a round opening, closed, from z = −depth to 0.
void add_round_panel(MeshBuilder& b, glm::vec2 centre, float half, float radius, float depth, int eighths) {
    const int count = 8 * eighths;
    const auto direction = [&](float u) {
        const int i = static_cast<int>(std::lround(u * count)) % count;
        const float angle = 2 * pi * static_cast<float>(i) / count;
        return glm::vec2(std::cos(angle), std::sin(angle));
    };
    const auto inner = [&](float u) { return centre + radius * direction(u); };
    const auto outer = [&](float u) {
        const glm::vec2 d = direction(u);
        return centre + half / std::max(std::abs(d.x), std::abs(d.y)) * d;
    };
    b.grid(count, 1, [&](float u, float v) {
        const glm::vec2 p = v > 0.5f ? inner(u) : outer(u);
        return Vertex{{p, 0}, {0, 0, 1}, p};
    });
    b.grid(count, 1, [&](float u, float v) {
        const glm::vec2 p = v > 0.5f ? outer(u) : inner(u);
        return Vertex{{p, -depth}, {0, 0, -1}, p};
    });
    b.grid(count, 1, [&](float u, float v) {
        return Vertex{{inner(u), -depth * v}, {-direction(u), 0}, {radius * 6.28f * u, depth * v}};
    });
    for (int side = 0; side < 4; ++side) {  // from corner to corner
        const glm::mat4 before = b.transform;
        const float from = (2 * static_cast<float>(side) - 1) / 8;
        const glm::vec2 out = glm::round(direction(from + 0.125f));
        b.grid(2 * eighths, 1, [&](float u, float v) {
            const glm::vec2 p = outer(from + 0.25f * u + 1);
            return Vertex{{p, -depth * (1 - v)}, {out, 0}, {u, v}};
        });
        b.transform = before;
    }
}

void add_rose(MeshBuilder& b, glm::vec2 centre, float radius, const Detail& detail) {
    const auto ring = [&](glm::vec2 at, float r, float thick, float depth, int segments) {
        const Profile profile{{r - thick, -0.5f * depth}, {r, -depth}, {r + thick, -0.5f * depth},
                              {r + thick, 0.5f * depth},  {r, depth},  {r - thick, 0.5f * depth}};
        auto frames = arc_frames({at, 0}, {1, 0, 0}, {0, 0, -1}, 0, 360, segments);
        frames.back() = frames.front();
        round_moulding(b, profile, frames);
    };
    constexpr int spokes = 12;
    const glm::mat4 before = b.transform;
    b.transform = glm::translate(before, {0, 0, -0.4f});
    ring(centre, radius - 0.02f, 0.1f, 0.14f, detail.segments(48, 16));
    ring(centre, 0.34f * radius, 0.07f, 0.1f, detail.segments(24, 10));
    ring(centre, 0.17f * radius, 0.05f, 0.08f, detail.segments(16, 8));
    for (int i = 0; i < spokes; ++i) {
        const float angle = 2 * pi * static_cast<float>(i) / spokes, between = angle + pi / spokes;
        const glm::vec2 d(std::cos(angle), std::sin(angle)), e(std::cos(between), std::sin(between));
        bar(b, {centre + 0.34f * radius * d, 0}, {centre + 0.8f * radius * d, 0}, 0.05f,
            detail.segments(8, 5));
        ring(centre + 0.8f * radius * e, 0.19f * radius, 0.045f, 0.07f, detail.segments(16, 8));
    }
    b.transform = before;
}

}  // namespace

void add_apse(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder wall, trim, dome;
    add_apse_walls(wall, trim, detail);
    add_dome_ribs(trim, detail);
    add_dome(dome, detail.segments(4, 2), detail.segments(10, 5));
    add_mesh(scene, wall.take("apse walls", materials.stone));
    add_mesh(scene, trim.take("apse mouldings", materials.pale));
    add_mesh(scene, dome.take("apse vault", materials.vault));
}

void add_west_front(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder wall, trim, door;
    // Its front looks at the nave.
    const glm::mat4 west =
        glm::rotate(glm::translate(glm::mat4(1), {-nave_end, 0, 0}), glm::half_pi<float>(), {0, 1, 0});
    wall.transform = trim.transform = door.transform = west;
    const float rose_half = 0.5f * (vault_top - arcade_top), rose_y = arcade_top + rose_half, depth = 0.9f;
    arched_panel(wall, {2 * arcade_back, -0.05f, arcade_top, -0.05f, 2.7f, 1.15f, depth},
                 detail.segments(20, 8));
    add_round_panel(wall, {0, rose_y}, rose_half, 2.25f, depth, detail.segments(5, 2));
    for (const float s : {-1.0f, 1.0f}) {
        wall.box({std::min(s * rose_half, s * arcade_back), arcade_top, -depth},
                 {std::max(s * rose_half, s * arcade_back), vault_top, 0});
        wall.box({std::min(s * arcade_back, s * outside), -0.05f, -depth},
                 {std::max(s * arcade_back, s * outside), aisle_top, 0});
    }
    add_rose(trim, {0, rose_y}, 2.25f, detail);
    for (const float r : {1.22f, 1.45f}) {
        const Profile roll{{r - 0.09f, -0.05f}, {r, -0.1f}, {r + 0.09f, -0.05f},
                           {r + 0.09f, 0.05f},  {r, 0.1f},  {r - 0.09f, 0.05f}};
        moulding(trim, roll,
                 arc_frames({0, 2.7f, 0.02f}, {1, 0, 0}, {0, 0, -1}, 0, 180, detail.segments(20, 8)));
        for (const float s : {-1.0f, 1.0f})
            bar(trim, {s * r, -0.02f, 0.02f}, {s * r, 2.72f, 0.02f}, 0.085f, detail.segments(8, 5));
    }
    Outline leaf{{-1.17f, 0}, {1.17f, 0}, {1.17f, 2.7f}};
    add_arc(leaf, {0, 2.7f}, 1.17f, 6, 174, detail.segments(14, 6));
    leaf.push_back({-1.17f, 2.7f});
    plate(door, {leaf, -0.55f, -0.45f, 0, {0, 1.5f}});
    for (int i = 0; i < 4; ++i)
        for (const float s : {-1.0f, 1.0f})
            block(door, {std::min(s * 0.12f, s * 1.0f), 0.2f + 0.72f * static_cast<float>(i), -0.47f},
                  {std::max(s * 0.12f, s * 1.0f), 0.8f + 0.72f * static_cast<float>(i), -0.41f}, 0.025f);
    // East ends of the aisles.
    wall.transform = glm::mat4(1);
    for (const float s : {-1.0f, 1.0f})
        wall.box({nave_end, -0.05f, std::min(s * nave, s * outside)},
                 {nave_end + 0.9f, aisle_top, std::max(s * nave, s * outside)});
    add_mesh(scene, wall.take("west front", materials.stone));
    add_mesh(scene, trim.take("rose window", materials.pale));
    add_mesh(scene, door.take("door", materials.wood));
}

}  // namespace ir::scene::builtin::cathedral_parts
