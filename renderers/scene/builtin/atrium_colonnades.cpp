// Columns and corner piers on both storeys, and the balustrade of the gallery.

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/atrium.h"
#include "renderers/scene/builtin/column.h"

namespace ir::scene::builtin::atrium_parts {
namespace {

void add_columns(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder lower, upper;
    const int segments = detail.segments(18, 6);
    for (const auto& side : sides())
        for (int i = 1; i < side.bays; ++i) {
            const float x = i * bay - side.half();
            lower.transform = upper.transform = side.transform;
            column(lower, {{x, 0, 0}, lower_spring, 0.28f}, segments);
            column(upper, {{x, gallery_floor, 0}, upper_spring - gallery_floor, 0.21f, 12}, segments);
        }
    add_mesh(scene, lower.take("lower columns", m.limestone));
    add_mesh(scene, upper.take("upper columns", m.limestone));
}

void add_corner_piers(Scene& scene, const Materials& m) {
    MeshBuilder b;
    const auto block = [&](glm::vec2 c, float half, float low, float high) {
        b.box({c.x - half, low, c.y - half}, {c.x + half, high, c.y + half});
    };
    for (const float x : {-1.0f, 1.0f})
        for (const float z : {-1.0f, 1.0f}) {
            const glm::vec2 c = court * glm::vec2(x, z);
            block(c, 0.36f, -0.05f, ceiling + 0.05f);
            block(c, 0.43f, -0.02f, 0.34f);
            block(c, 0.43f, lower_spring - 0.15f, lower_spring + 0.012f);
            block(c, 0.36f, gallery_floor - 0.05f, upper_wall_top - 0.01f);
            block(c, 0.41f, gallery_floor - 0.02f, gallery_floor + 0.26f);
            block(c, 0.41f, upper_spring - 0.13f, upper_spring + 0.012f);
        }
    add_mesh(scene, b.take("corner piers", m.limestone));
}

/// From one column's axis to the next: plinth, balusters and a rounded hand rail.
void add_balustrade_bay(MeshBuilder& b, float middle, const Detail& detail) {
    const float y = gallery_floor, low = middle - bay / 2 + 0.15f, high = middle + bay / 2 - 0.15f;
    b.box({low, y - 0.01f, -0.11f}, {high, y + 0.1f, 0.11f});
    Profile rail;
    add_arc(rail, {0.06f, 0.06f}, 0.06f, 0, 90, detail.segments(4, 2));
    add_arc(rail, {-0.06f, 0.06f}, 0.06f, 90, 180, detail.segments(4, 2));
    rail.insert(rail.begin(), {{-0.08f, -0.04f}, {0.08f, -0.04f}, {0.12f, 0.02f}});
    rail.push_back({-0.12f, 0.02f});
    rail.push_back({-0.08f, -0.04f});
    sweep(b, rail,
          {{{low, y + 0.86f, 0}, {0, 0, 1}, {0, 1, 0}}, {{high, y + 0.86f, 0}, {0, 0, 1}, {0, 1, 0}}});
    const int balusters = detail.is_plain() ? 5 : 8;
    const float first = middle - 0.98f;
    for (int i = 0; i < balusters; ++i)
        baluster(b, {first + i * 1.96f / float(balusters - 1), y + 0.1f, 0}, 0.73f, detail.segments(9, 4),
                 detail.segments(10, 3));
}

void add_balustrades(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder b;
    for (const auto& side : sides()) {
        b.transform = side.transform;
        for (int i = 0; i < side.bays; ++i) add_balustrade_bay(b, (i + 0.5f) * bay - side.half(), detail);
    }
    add_mesh(scene, b.take("balustrades", m.limestone));
}

}  // namespace

void add_colonnades(Scene& scene, const Materials& materials, const Detail& detail) {
    add_columns(scene, materials, detail);
    add_corner_piers(scene, materials);
    add_balustrades(scene, materials, detail);
}

}  // namespace ir::scene::builtin::atrium_parts
