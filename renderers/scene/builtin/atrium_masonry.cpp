// Floors, outer walls with their blind arcades, arcades around the court, vaults and cornices.

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/atrium.h"

namespace ir::scene::builtin::atrium_parts {
namespace {

void add_floors(Scene& scene, const Materials& m) {
    MeshBuilder b;
    const float deep = -0.8f;
    ring(b, {wall + 0.1f, court - 0.45f, deep, 0, deep, 0});
    ring(b, {wall - 0.1f, court - 0.4f, ceiling, gallery_floor, ceiling, gallery_floor});
    add_mesh(scene, b.take("aisle floors", m.tiles));
    ring(b, {court - 0.44f, court - 0.8f, deep, court_floor / 2, deep, court_floor / 2});
    add_mesh(scene, b.take("step", m.limestone));
    const glm::vec2 c = court - 0.79f;
    b.box({-c.x, deep, -c.y}, {c.x, court_floor, c.y});
    add_mesh(scene, b.take("court floor", m.tiles));
}

void add_outer_walls(Scene& scene, const Materials& m) {
    MeshBuilder b;
    ring(b, {wall + 0.5f, wall, -0.8f, 12, -0.8f, 12});
    add_mesh(scene, b.take("outer walls", m.bricks));
    ring(b, {wall + 0.56f, wall - 0.06f, 11.99f, 12.12f, 11.99f, 12.12f});
    add_mesh(scene, b.take("coping", m.limestone));
}

struct Storey {
    float bottom, top, sill, spring, radius;
};
constexpr Storey lower_niches{-0.05f, ceiling + 0.1f, 0.95f, 2.25f, 0.75f};
constexpr Storey upper_niches{gallery_floor - 0.05f, 10.9f, 6.45f, 7.9f, 0.7f};

/// The panels of one side from corner to corner: one for each bay and one at both ends.
void add_blind_side(MeshBuilder& b, const Side& side, const Storey& s, int segments) {
    const float end = side.wall_half - side.half();
    for (int i = -1; i <= side.bays; ++i) {
        const bool is_end = i < 0 || i == side.bays;
        const float x = is_end ? (i < 0 ? -1 : 1) * (side.half() + end / 2) : (i + 0.5f) * bay - side.half();
        glm::mat4 local = glm::translate(side.transform, {x, 0, side.to_wall - leaf_depth});
        b.transform = glm::scale(local, {-1, 1, -1});  // half a turn: the front faces the court
        arched_panel(
            b, {is_end ? end : bay, s.bottom, s.top, s.sill, s.spring, s.radius, leaf_depth + 0.02f, false},
            segments);
    }
    b.transform = glm::mat4(1);
}

void add_pilasters(MeshBuilder& b, const Side& side) {
    b.transform = side.transform;
    const float face = side.to_wall - leaf_depth;
    for (int i = 0; i <= side.bays; ++i) {
        const float x = i * bay - side.half();
        b.box({x - 0.2f, -0.02f, face - 0.12f}, {x + 0.2f, lower_spring - 0.02f, face + 0.05f});
        b.box({x - 0.25f, -0.02f, face - 0.17f}, {x + 0.25f, 0.28f, face + 0.05f});
        b.box({x - 0.25f, lower_spring - 0.14f, face - 0.17f},
              {x + 0.25f, lower_spring + 0.01f, face + 0.05f});
        b.box({x - 0.18f, gallery_floor - 0.02f, face - 0.09f}, {x + 0.18f, 10.9f, face + 0.05f});
    }
    b.transform = glm::mat4(1);
}

void add_blind_arcades(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder b;
    for (const auto& side : sides()) {
        add_blind_side(b, side, lower_niches, detail.segments(20, 5));
        add_blind_side(b, side, upper_niches, detail.segments(20, 5));
    }
    add_mesh(scene, b.take("blind arcades", m.plaster));
    for (const auto& side : sides()) add_pilasters(b, side);
    add_mesh(scene, b.take("pilasters", m.limestone));
    const Profile plinth{{0.0f, -0.02f}, {0.06f, -0.02f}, {0.06f, 0.3f}, {0.02f, 0.36f}, {-0.02f, 0.36f}};
    Profile sill{{-0.02f, 0.86f}, {0.05f, 0.88f}, {0.08f, 0.9f}, {0.08f, 0.97f}, {-0.02f, 0.99f}};
    for (float y : {0.0f, 5.5f}) {
        Profile low = plinth, high = sill;
        for (auto& p : low) p.y += y > 0 ? gallery_floor : 0;
        for (auto& p : high) p.y += y;
        inner_moulding(b, wall - leaf_depth, low);
        inner_moulding(b, wall - leaf_depth, high);
    }
    add_mesh(scene, b.take("wall mouldings", m.limestone));
}

/// Mouldings around an arch, on both faces of its wall.
void add_archivolt(MeshBuilder& b, float spring, float radius, float face, int segments) {
    const float f = face - 0.01f;
    Profile p{{radius + 0.19f, f}, {radius + 0.19f, f + 0.05f}, {radius + 0.13f, f + 0.08f}};
    if (segments > 10) {
        p.push_back({radius + 0.07f, f + 0.08f});
        add_arc(p, {radius + 0.035f, f + 0.075f}, 0.03f, 10, 170, segments / 6);
    }
    p.push_back({radius + 0.001f, f + 0.045f});
    p.push_back({radius + 0.001f, f});
    for (const float z : {1.0f, -1.0f}) {
        std::vector<Frame> frames;
        for (int i = 0; i <= segments; ++i) {
            const float angle = glm::radians(180.0f * i / segments);
            frames.push_back({{0, spring, 0}, {std::cos(angle), std::sin(angle), 0}, {0, 0, z}});
        }
        sweep(b, p, frames);
    }
}

/// A wedge-shaped stone at an arch's crown that stands out on both faces.
void add_keystone(MeshBuilder& b, float spring, float radius, float depth) {
    const float low = spring + radius - 0.05f, high = spring + radius + 0.34f, z = depth / 2 + 0.11f;
    const glm::vec2 q[4] = {{-0.08f, low}, {0.08f, low}, {0.13f, high}, {-0.13f, high}};
    const auto at = [&](int i, float side) { return glm::vec3(q[i % 4], side * z); };
    b.quad(at(0, 1), at(1, 1), at(2, 1), at(3, 1));
    b.quad(at(1, -1), at(0, -1), at(3, -1), at(2, -1));
    for (int i = 0; i < 4; ++i) b.quad(at(i, -1), at(i + 1, -1), at(i + 1, 1), at(i, 1));
}

void add_arcades(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder walls, trim;
    const int segments = detail.segments(21, 7);
    for (const auto& side : sides())
        for (int i = 0; i < side.bays; ++i) {
            const glm::mat4 middle = glm::translate(side.transform, {(i + 0.5f) * bay - side.half(), 0, 0});
            trim.transform = middle;
            walls.transform = glm::translate(middle, {0, 0, lower_depth / 2});
            arched_panel(
                walls,
                {bay, lower_spring, ceiling + 0.02f, lower_spring, lower_spring, lower_arch, lower_depth},
                segments);
            add_archivolt(trim, lower_spring, lower_arch, lower_depth / 2, segments);
            add_keystone(trim, lower_spring, lower_arch, lower_depth);
            walls.transform = glm::translate(middle, {0, 0, upper_depth / 2});
            arched_panel(
                walls,
                {bay, upper_spring, upper_wall_top, upper_spring, upper_spring, upper_arch, upper_depth},
                segments);
            add_archivolt(trim, upper_spring, upper_arch, upper_depth / 2, segments);
            add_keystone(trim, upper_spring, upper_arch, upper_depth);
        }
    add_mesh(scene, walls.take("arcades", m.plaster));
    add_mesh(scene, trim.take("archivolts", m.limestone));
}

void add_vaults(Scene& scene, const Materials& m, const Detail& detail) {
    std::vector<float> xs{-wall.x + 0.2f}, zs{-wall.y + 0.2f};
    for (int i = 0; i <= 8; ++i) xs.push_back(i * bay - court.x);
    for (int i = 0; i <= 3; ++i) zs.push_back(i * bay - court.y);
    xs.push_back(wall.x - 0.2f);
    zs.push_back(wall.y - 0.2f);
    MeshBuilder b;
    const float rise = 1.35f;
    for (std::size_t i = 0; i + 1 < xs.size(); ++i)
        for (std::size_t j = 0; j + 1 < zs.size(); ++j) {
            const bool is_court = i > 0 && i + 2 < xs.size() && j > 0 && j + 2 < zs.size();
            if (!is_court)
                groin_vault(b, {xs[i], zs[j]}, {xs[i + 1], zs[j + 1]}, lower_spring, rise,
                            detail.segments(7, 2));
        }
    add_mesh(scene, b.take("vaults", m.vault));
    for (const auto& side : sides())
        for (int i = 0; i <= side.bays; ++i) {
            b.transform = glm::translate(side.transform, {i * bay - side.half(), 0, 0});
            rib(b, side.to_wall - 0.2f, lower_spring, rise, 0.34f, 0.14f, detail.segments(24, 8));
        }
    add_mesh(scene, b.take("vault ribs", m.limestone));
}

void add_dentils(MeshBuilder& b, float y) {
    for (const auto& side : sides()) {
        b.transform = side.transform;
        const float half = side.half() - 0.5f;
        const int count = static_cast<int>(2 * half / 0.2f);
        for (int i = 0; i <= count; ++i) {
            const float x = -half + 2 * half * i / count;
            b.box({x - 0.05f, y - 0.11f, -0.38f}, {x + 0.05f, y, -0.28f});
        }
    }
    b.transform = glm::mat4(1);
}

void add_cornices(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder b;
    Profile p{{-0.03f, ceiling - 0.16f}, {0.03f, ceiling - 0.12f}, {0.03f, ceiling - 0.04f}};
    add_arc(p, {0.03f, ceiling + 0.02f}, 0.06f, -90, 0, detail.segments(5, 2));
    p.push_back({0.1f, ceiling + 0.09f});
    p.push_back({0.1f, ceiling + 0.3f});
    add_arc(p, {0.1f, gallery_floor - 0.05f}, 0.045f, -90, 90, detail.segments(6, 3));
    p.push_back({-0.1f, gallery_floor - 0.004f});
    inner_moulding(b, court - 0.4f, p);
    if (!detail.is_plain()) add_dentils(b, ceiling - 0.15f);
    add_mesh(scene, b.take("cornice", m.limestone));
}

}  // namespace

void add_masonry(Scene& scene, const Materials& materials, const Detail& detail) {
    add_floors(scene, materials);
    add_outer_walls(scene, materials);
    add_blind_arcades(scene, materials, detail);
    add_arcades(scene, materials, detail);
    add_vaults(scene, materials, detail);
    add_cornices(scene, materials, detail);
}

}  // namespace ir::scene::builtin::atrium_parts
