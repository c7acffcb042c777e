// What stands in the halls and throws shadows.

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/corridor.h"
#include "renderers/scene/builtin/interior_textures.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin::corridor_parts {
namespace {

void add_crates(Scene& scene, const Detail& detail) {
    struct Crate {
        glm::vec3 foot;
        float side, turn;
    };
    const std::array<Crate, 6> crates = {{{{4.4f, 0, 1.35f}, 0.8f, 8},
                                          {{4.35f, 0.8f, 1.3f}, 0.5f, 32},
                                          {{5.35f, 0, 1.5f}, 0.6f, -12},
                                          {{8.0f, 0, 1.4f}, 0.7f, 20},
                                          {{14.6f, 0, 1.3f}, 0.85f, -9},
                                          {{15.6f, 0, 1.45f}, 0.55f, 27}}};
    MeshBuilder b;
    for (const auto& c : crates) {
        b.transform = glm::rotate(glm::translate(glm::mat4(1), c.foot), glm::radians(c.turn), {0, 1, 0});
        const float h = c.side / 2;
        slab(b, {{-h, -0.003f, -h}, {h, c.side, h}, 0.012f, 0.01f}, detail.segments(3, 2));
        for (const float y : {0.12f * c.side, 0.8f * c.side})  // battens
            for (int i = 0; i < 4; ++i) {
                const glm::mat4 before = b.transform;
                b.transform = glm::rotate(before, glm::radians(90.0f * i), {0, 1, 0});
                const float half = h - 0.03f + 0.001f * i;
                b.box({-half, y, h - 0.01f}, {half, y + 0.09f * c.side, h + 0.02f});
                b.transform = before;
            }
    }
    const int wooden = add_textured(
        scene, "crates", {wood("crates", {0.5f, 0.36f, 0.2f}, {0.34f, 0.22f, 0.11f}), {}}, 0.9f, 0.85f);
    add_mesh(scene, b.take("crates", wooden));
}

void add_columns(Scene& scene, const Detail& detail) {
    MeshBuilder b;
    const int around = detail.segments(40, 12), bends = detail.segments(6, 3);
    for (const glm::vec3 foot : {glm::vec3(3.1f, 0, -1.1f), glm::vec3(16.2f, 0, 0.7f)}) {
        Profile p{{0, -0.01f}, {0.34f, -0.01f}, {0.34f, 0.1f}};
        add_arc(p, {0.27f, 0.16f}, 0.06f, -90, 90, bends);
        p.push_back({0.22f, 0.24f});
        p.push_back({0.19f, hall_height - 0.3f});
        add_arc(p, {0.2f, hall_height - 0.26f}, 0.04f, -90, 90, bends);
        p.push_back({0.3f, hall_height - 0.12f});
        p.push_back({0.3f, hall_height + 0.01f});
        p.push_back({0, hall_height + 0.01f});
        lathe(b, foot, p, around);
    }
    add_mesh(scene, b.take("columns", add_material(scene, "stone", {0.6f, 0.56f, 0.5f}, 0.85f)));
}

/// Pedestals with a ball, a ring and a vase on them.
void add_sculptures(Scene& scene, const Detail& detail) {
    const glm::vec3 feet[3] = {{1.7f, 0, -1.45f}, {10.9f, 0, -1.2f}, {13.6f, 0, -1.4f}};
    const int around = detail.segments(48, 14);
    MeshBuilder stone, things;
    for (const auto& foot : feet) {
        stone.box(foot + glm::vec3(-0.24f, -0.004f, -0.24f), foot + glm::vec3(0.24f, 0.75f, 0.24f));
        stone.box(foot + glm::vec3(-0.29f, 0.74f, -0.29f), foot + glm::vec3(0.29f, 0.8f, 0.29f));
    }
    add_mesh(scene, stone.take("pedestals", add_material(scene, "marble", {0.7f, 0.68f, 0.66f}, 0.4f)));
    ball(things, feet[0] + glm::vec3(0, 1.048f, 0), 0.25f, around);
    things.transform = glm::rotate(glm::translate(glm::mat4(1), feet[1] + glm::vec3(0, 1.137f, 0)),
                                   glm::radians(35.0f), {0, 1, 0});
    const auto circle = [](float t) {
        const float angle = 2 * std::numbers::pi_v<float> * t;
        return glm::vec3(0.25f * std::cos(angle), 0.25f * std::sin(angle), 0);
    };
    tube(things, {circle, [](float) { return 0.09f; }, {0, 0, 1}, true}, around, around / 2);
    things.transform = glm::mat4(1);
    Profile vase{{0, 0}, {0.1f, 0}, {0.11f, 0.02f}};
    add_arc(vase, {0.05f, 0.22f}, 0.17f, -62, 50, around / 3);
    add_arc(vase, {0.235f, 0.46f}, 0.135f, 230, 160, around / 4);
    add_arc(vase, {0.1f, 0.53f}, 0.01f, 0, 170, 4);
    vase.push_back({0.075f, 0.42f});
    vase.push_back({0, 0.3f});
    lathe(things, feet[2] + glm::vec3(0, 0.798f, 0), vase, around);
    const int bronze = add_material(scene, "bronze", {0.72f, 0.48f, 0.22f}, 0.4f);
    scene.materials[bronze].metallic = 1;
    add_mesh(scene, things.take("sculptures", bronze));
}

void add_screen_and_steps(Scene& scene) {
    MeshBuilder b;
    b.box({9.05f, -0.01f, 0.35f}, {9.17f, 1.5f, 2.02f});
    add_mesh(scene, b.take("screen", add_material(scene, "orange paint", {0.72f, 0.28f, 0.04f})));
    for (int i = 0; i < 3; ++i)
        b.box({17.3f + 0.4f * i, -0.01f, -0.2f + 0.02f * i},
              {18.62f + 0.01f * i, 0.18f * (i + 1), 2.02f + 0.01f * i});
    add_mesh(scene, b.take("steps", static_cast<int>(scene.meshes.back().material)));
    b.box({7.6f, 0.4f, -2.01f}, {9.8f, 0.46f, -1.55f});
    for (const float x : {7.75f, 9.55f}) b.box({x, -0.005f, -1.95f}, {x + 0.08f, 0.41f, -1.6f});
    add_mesh(scene, b.take("bench", add_material(scene, "bench", {0.25f, 0.16f, 0.1f}, 0.7f)));
}

}  // namespace

void add_things(Scene& scene, const Detail& detail) {
    add_crates(scene, detail);
    add_columns(scene, detail);
    add_sculptures(scene, detail);
    add_screen_and_steps(scene);
}

}  // namespace ir::scene::builtin::corridor_parts
