// Round piers with four shafts, bases and crocket capitals, and the shafts that carry the ribs.

#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/cathedral.h"
#include "renderers/scene/builtin/plates.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin::cathedral_parts {
namespace {

constexpr float core = 0.43f, base_top = 0.82f, capital = 0.75f;

Profile pier_profile(float height, int bends) {
    Profile p{{0, 0.2f}, {0.62f, 0.2f}, {0.62f, 0.32f}};
    add_arc(p, {0.53f, 0.4f}, 0.08f, -80, 90, bends);
    p.push_back({0.5f, 0.5f});
    add_arc(p, {0.52f, 0.56f}, 0.05f, 250, 110, std::max(1, bends / 2));
    add_arc(p, {0.46f, 0.66f}, 0.05f, -90, 90, bends);
    p.push_back({0.47f, 0.73f});
    p.push_back({core, base_top});
    const float neck = height - capital;
    add_arc(p, {core, neck}, 0.05f, -90, 90, bends);
    for (const float t : {0.3f, 0.6f, 0.85f, 1.0f})
        p.push_back({core + 0.16f * t * t * t, neck + 0.05f + (capital - 0.3f) * t});
    p.push_back({0.62f, height - 0.22f});
    p.push_back({0, height - 0.22f});
    return p;
}

/// A stem along the bell that curls over into a knob.
void add_crocket(MeshBuilder& b, glm::vec3 foot, float angle, float height, float size,
                 const Detail& detail) {
    const glm::vec3 out(std::cos(angle), 0, std::sin(angle));
    const auto at = [&](float reach, float y) { return foot + reach * out + glm::vec3(0, y, 0); };
    const std::vector<glm::vec3> way{at(core + 0.01f, 0), at(core + 0.06f, 0.5f * height),
                                     at(core + 0.14f, 0.85f * height), at(core + 0.25f, 0.95f * height),
                                     at(core + 0.33f, 0.8f * height)};
    const std::vector<float> radii{0.5f * size, 0.7f * size, 0.55f * size, 0.7f * size, 0.4f * size};
    limb(b, way, radii, detail.segments(6, 3));
}

void add_pier(MeshBuilder& b, glm::vec3 foot, const Detail& detail) {
    const float height = arcade_spring;
    const int segments = detail.segments(26, 6);
    lying_block(b, foot + glm::vec3(-0.68f, -0.03f, -0.68f), foot + glm::vec3(0.68f, 0.14f, 0.68f), 0.03f);
    lying_block(b, foot + glm::vec3(-0.63f, 0.12f, -0.63f), foot + glm::vec3(0.63f, 0.24f, 0.63f), 0.02f);
    lathe(b, foot, pier_profile(height, detail.segments(3, 1)), segments);
    const float neck = height - capital;
    for (int i = 0; i < 4; ++i) {
        const float angle = 0.5f * pi * static_cast<float>(i) + 0.25f * pi;
        const glm::vec3 at = foot + (core + 0.05f) * glm::vec3(std::cos(angle), 0, std::sin(angle));
        bar(b, at + glm::vec3(0, 0.62f, 0), at + glm::vec3(0, neck + 0.03f, 0), 0.095f,
            detail.segments(10, 4));
        lathe(b, at,
              {{0, 0.22f},
               {0.17f, 0.22f},
               {0.18f, 0.45f},
               {0.14f, 0.6f},
               {0.155f, 0.68f},
               {0.1f, 0.75f},
               {0, 0.75f}},
              detail.segments(10, 4));
    }
    if (!detail.is_plain())
        for (int i = 0; i < 8; ++i) {
            const float angle = 0.25f * pi * static_cast<float>(i);
            add_crocket(b, foot + glm::vec3(0, neck + 0.06f, 0), angle, i % 2 ? 0.52f : 0.4f, 0.075f, detail);
        }
    lying_block(b, foot + glm::vec3(-0.6f, height - 0.24f, -0.6f),
                foot + glm::vec3(0.6f, height - 0.14f, 0.6f), 0.03f);
    lying_block(b, foot + glm::vec3(-0.66f, height - 0.15f, -0.66f),
                foot + glm::vec3(0.66f, height + 0.01f, 0.66f), 0.025f);
}

/// Three shafts on the nave's wall, from the pier to the springing of the vault, with a capital.
void add_wall_shafts(MeshBuilder& b, float x, float z, float out, const Detail& detail) {
    const float foot = arcade_spring + 0.35f, top = vault_spring, r[3] = {0.075f, 0.11f, 0.075f};
    const int segments = detail.segments(10, 4);
    for (int k = 0; k < 3; ++k) {
        const glm::vec3 at(x + 0.17f * (static_cast<float>(k) - 1), 0, z + out * (k == 1 ? 0.1f : 0.03f));
        Profile p{{0, foot - 0.22f}, {0.5f * r[k], foot - 0.22f}, {1.5f * r[k], foot}, {r[k], foot + 0.08f}};
        for (const float ring : {arcade_top, triforium_top}) {
            p.push_back({r[k], ring - 0.09f});
            p.push_back({1.5f * r[k], ring});
            p.push_back({r[k], ring + 0.09f});
        }
        for (const glm::vec2 q :
             {glm::vec2(1, top - 0.5f), glm::vec2(1.4f, top - 0.46f), glm::vec2(1, top - 0.42f),
              glm::vec2(1.2f, top - 0.25f), glm::vec2(1.9f, top - 0.12f)})
            p.push_back({r[k] * q.x, q.y});
        p.push_back({0, top - 0.12f});
        lathe(b, at, p, segments);
    }
    lying_block(b, {x - 0.36f, top - 0.13f, std::min(z - 0.05f * out, z + 0.3f * out)},
                {x + 0.36f, top + 0.02f, std::max(z - 0.05f * out, z + 0.3f * out)}, 0.03f);
}

/// On the outer wall, to where the aisle's ribs begin.
void add_respond(MeshBuilder& b, float x, const Detail& detail) {
    const float r = 0.15f, h = arcade_spring;
    lathe(b, {x, 0, aisle - 0.06f},
          {{0, -0.02f},
           {0.26f, -0.02f},
           {0.26f, 0.3f},
           {0.21f, 0.36f},
           {0.22f, 0.46f},
           {r, 0.55f},
           {r, h - 0.55f},
           {0.2f, h - 0.51f},
           {r, h - 0.46f},
           {0.17f, h - 0.3f},
           {0.26f, h - 0.14f},
           {0, h - 0.14f}},
          detail.segments(12, 4));
    lying_block(b, {x - 0.3f, h - 0.15f, aisle - 0.36f}, {x + 0.3f, h + 0.02f, aisle + 0.02f}, 0.03f);
}

}  // namespace

void add_piers(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder piers, shafts;
    for (int s = 0; s < 2; ++s) {
        piers.transform = shafts.transform = side_transform(s);
        for (int i = 0; i <= bays; ++i) {
            add_pier(piers, {pier_axis(i), 0, pier_z}, detail);
            add_wall_shafts(shafts, pier_axis(i), nave, -1, detail);
            add_respond(shafts, pier_axis(i), detail);
        }
    }
    add_mesh(scene, piers.take("piers", materials.pale));
    add_mesh(scene, shafts.take("shafts", materials.marble));
}

}  // namespace ir::scene::builtin::cathedral_parts
