// Fountain, planters with leaves, ivy, lanterns on chains and iron grilles.

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/atrium.h"
#include "renderers/scene/builtin/random.h"

namespace ir::scene::builtin::atrium_parts {
namespace {

void add_fountain(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder b;
    const glm::vec3 foot{0, court_floor, 0};
    const int around = detail.segments(40, 12), bends = detail.segments(6, 3);
    Profile basin{{1.72f, -0.02f}, {1.72f, 0.1f}, {1.62f, 0.13f}, {1.56f, 0.2f}, {1.54f, 0.42f}};
    add_arc(basin, {1.55f, 0.5f}, 0.08f, -90, 90, bends);
    add_arc(basin, {1.4f, 0.53f}, 0.05f, 90, 180, bends);
    basin.push_back({1.33f, 0.1f});
    basin.push_back({0.0f, 0.1f});
    lathe(b, foot, basin, around);
    Profile stem{{0.36f, 0.05f}, {0.36f, 0.2f}, {0.2f, 0.3f}};
    add_arc(stem, {0.12f, 0.62f}, 0.14f, -60, 60, bends);
    stem.push_back({0.11f, 0.95f});
    add_arc(stem, {0.1f, 1.6f}, 0.65f, -85, -8, 2 * bends);
    add_arc(stem, {0.72f, 1.54f}, 0.03f, 0, 180, bends);
    add_arc(stem, {0.1f, 1.62f}, 0.59f, -10, -80, 2 * bends);
    stem.push_back({0.08f, 1.7f});
    add_arc(stem, {0.0f, 1.8f}, 0.12f, -50, 90, bends);
    lathe(b, foot, stem, around);
    add_mesh(scene, b.take("fountain", m.limestone));
    const auto disc = [&](float radius, float y) {
        lathe(b, foot, {{radius, y}, {radius * 0.5f, y}, {0, y}}, around);
    };
    disc(1.4f, 0.4f);
    disc(0.66f, 1.45f);
    add_mesh(scene, b.take("water", m.water));
}

/// A leaf's quad with its stalk at `foot`.
void add_leaf(MeshBuilder& b, glm::vec3 foot, glm::vec3 way, glm::vec3 normal, float length) {
    const glm::vec3 along = glm::normalize(way), side = glm::normalize(glm::cross(normal, along));
    const glm::vec3 face = glm::cross(along, side);
    b.grid(1, 1, [&](float u, float v) {
        return Vertex{foot + (u - 0.5f) * 0.7f * length * side + (1 - v) * length * along, face, {u, v}};
    });
}

void add_bush(MeshBuilder& b, glm::vec3 centre, glm::vec3 radii, int leaves, Random& random) {
    for (int i = 0; i < leaves; ++i) {
        const glm::vec3 out = random.direction();
        const glm::vec3 foot = centre + radii * out * std::cbrt(random.between(0.15f, 1));
        add_leaf(b, foot, out + 0.8f * random.direction() + glm::vec3(0, 0.3f, 0), random.direction(),
                 random.between(0.1f, 0.2f));
    }
}

/// Ivy that falls from the hand rail over the court.
void add_ivy(MeshBuilder& b, float x, float drop, int leaves, Random& random) {
    for (int i = 0; i < leaves; ++i) {
        const float t = std::pow(random.unit(), 1.4f);
        const float across = random.between(-0.5f, 0.5f) * (1 - 0.7f * t);
        const float out = t < 0.08f ? -0.1f : t < 0.5f ? -0.2f - 0.8f * t : -0.6f;
        const glm::vec3 foot(x + across + 0.1f * std::sin(9 * t), gallery_floor + 1.02f - drop * t,
                             out - random.between(0, 0.1f));
        add_leaf(b, foot, glm::vec3(random.between(-0.6f, 0.6f), -1, random.between(-0.7f, 0)),
                 glm::vec3(random.between(-0.5f, 0.5f), 0.4f, -1), random.between(0.08f, 0.16f));
    }
}

void add_pot(MeshBuilder& b, glm::vec3 foot, const Detail& detail) {
    const int bends = detail.segments(4, 2);
    Profile p{{0.2f, -0.01f}, {0.2f, 0.05f}, {0.17f, 0.08f}};
    add_arc(p, {0.02f, 0.36f}, 0.28f, -55, 25, 2 * bends);
    p.push_back({0.25f, 0.54f});
    add_arc(p, {0.29f, 0.57f}, 0.03f, -90, 90, bends);
    p.push_back({0.25f, 0.6f});
    p.push_back({0.24f, 0.52f});
    p.push_back({0, 0.52f});
    lathe(b, foot, p, detail.segments(19, 8));
}

void add_plants(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder pots, leaves;
    Random random(20150907);
    for (const auto& side : sides()) {
        pots.transform = leaves.transform = side.transform;
        for (int i = 0; i < side.bays; ++i) {
            const float middle = (i + 0.5f) * bay - side.half();
            if (i % 2 == 0) {
                const glm::vec3 foot(middle + (side.bays == 8 ? bay / 2 : 0), court_floor, -1.15f);
                add_pot(pots, foot, detail);
                add_bush(leaves, foot + glm::vec3(0, 0.95f, 0), {0.42f, 0.45f, 0.42f}, detail.count(230),
                         random);
            }
            if (side.bays == 8 && i % 3 == 2) add_ivy(leaves, middle, 1.9f, detail.count(360), random);
        }
    }
    add_mesh(scene, pots.take("pots", m.roof));
    add_mesh(scene, leaves.take("leaves", m.leaf));
}

void add_link(MeshBuilder& b, glm::vec3 centre, float turn, int around, int along) {
    const auto position = [&](float u, float v) {
        const float a = 2 * pi * u, c = 2 * pi * v, out = 0.022f + 0.006f * std::cos(c);
        const glm::vec3 p(out * std::cos(a), 1.5f * out * std::sin(a), 0.006f * std::sin(c));
        return centre + glm::vec3(p.x * std::cos(turn) - p.z * std::sin(turn), p.y,
                                  p.x * std::sin(turn) + p.z * std::cos(turn));
    };
    b.surface(along, around, position);
}

/// Hangs from `hook` to a lantern whose glass is centred at `centre`.
void add_lantern(MeshBuilder& iron, MeshBuilder& glass, glm::vec3 centre, float hook_y,
                 const Detail& detail) {
    if (detail.is_plain()) rod(iron, centre + glm::vec3(0, 0.3f, 0), {centre.x, hook_y, centre.z}, 0.01f, 3);
    for (int i = 0; !detail.is_plain() && centre.y + 0.32f + 0.062f * i < hook_y; ++i)
        add_link(iron, centre + glm::vec3(0, 0.32f + 0.062f * i, 0), i % 2 * pi / 2, detail.segments(3, 3),
                 detail.segments(6, 4));
    lathe(iron, centre, {{0.0f, -0.2f}, {0.05f, -0.19f}, {0.15f, -0.15f}, {0.15f, -0.12f}, {0.0f, -0.12f}},
          6);
    lathe(iron, centre,
          {{0.0f, 0.14f}, {0.18f, 0.14f}, {0.18f, 0.16f}, {0.05f, 0.26f}, {0.02f, 0.3f}, {0, 0.31f}}, 6);
    lathe(glass, centre, {{0.1f, -0.13f}, {0.13f, 0.15f}}, 6);
    for (int i = 0; i < 6; ++i) {
        const float angle = pi / 3 * i;
        const glm::vec3 out(std::cos(angle), 0, std::sin(angle));
        rod(iron, centre + 0.115f * out + glm::vec3(0, -0.13f, 0),
            centre + 0.145f * out + glm::vec3(0, 0.15f, 0), 0.008f, detail.segments(5, 3));
    }
}

void add_lanterns(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder iron, glass;
    for (const auto& side : sides()) {
        iron.transform = glass.transform = side.transform;
        for (int i = 0; i < side.bays; ++i) {
            const float x = (i + 0.5f) * bay - side.half();
            if (i % 2 == 0) add_lantern(iron, glass, {x, 2.6f, (side.to_wall - 0.2f) / 2}, 4.68f, detail);
        }
    }
    add_mesh(scene, iron.take("lanterns", m.iron));
    add_mesh(scene, glass.take("lantern glass", m.lamp));
}

/// Iron in front of the niches: sheets with holes in a frame of bars.
void add_grilles(Scene& scene, const Materials& m) {
    MeshBuilder sheets, bars;
    for (const auto& side : sides())
        for (int i = 0; i < side.bays; ++i) {
            if (i % 2 == 0) continue;
            const glm::mat4 middle = glm::translate(
                side.transform, {(i + 0.5f) * bay - side.half(), 0, side.to_wall - leaf_depth + 0.07f});
            sheets.transform = bars.transform = middle;
            for (const float y : {0.97f, 6.47f}) {
                const float w = y > 5 ? 0.69f : 0.74f, h = 1.3f;
                sheets.grid(1, 1, [&](float u, float v) {
                    return Vertex{{w * (1 - 2 * u), y + h * v, 0}, {0, 0, -1}, {2 * u, 2 * (1 - v)}};
                });
                for (const float edge : {y, y + h})
                    bars.box({-w - 0.02f, edge - 0.02f, -0.02f}, {w + 0.02f, edge + 0.02f, 0.02f});
            }
        }
    add_mesh(scene, sheets.take("grilles", m.grille));
    add_mesh(scene, bars.take("grille bars", m.iron));
}

}  // namespace

void add_furnishings(Scene& scene, const Materials& materials, const Detail& detail) {
    add_fountain(scene, materials, detail);
    add_plants(scene, materials, detail);
    add_lanterns(scene, materials, detail);
    add_grilles(scene, materials);
}

}  // namespace ir::scene::builtin::atrium_parts
