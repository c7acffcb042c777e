// Teapot, bottle and candlestick; balls and rings of metal and plastic.

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/solids.h"
#include "renderers/scene/builtin/still_life.h"

namespace ir::scene::builtin::still_life_parts {
namespace {

constexpr float sink = 0.0005f;  ///< of what stands on the table into it

glm::vec3 on_table(float x, float z, float above = 0) {
    return table_top + glm::vec3(x, above - sink, z);
}

Profile teapot_profile(int bends) {
    Profile p{{0, 0}, {0.05f, 0}, {0.053f, 0.005f}};
    add_arc(p, {0.012f, 0.062f}, 0.07f, -52, 62, 2 * bends);
    p.push_back({0.04f, 0.127f});
    p.push_back({0.042f, 0.131f});  // the lid
    add_arc(p, {0, 0.098f}, 0.0505f, 40, 78, bends);
    add_arc(p, {0, 0.161f}, 0.014f, -50, 90, bends);
    return p;
}

void add_teapot(Scene& scene, const Detail& detail) {
    MeshBuilder b;
    const int bends = detail.segments(10, 4), along = detail.segments(24, 8), around = detail.segments(18, 8);
    b.transform =
        glm::rotate(glm::translate(glm::mat4(1), on_table(-0.1f, -0.13f)), glm::radians(-28.0f), {0, 1, 0});
    lathe(b, {0, 0, 0}, teapot_profile(bends), detail.segments(56, 16));
    const auto spout = [](float t) {
        return glm::vec3(0.055f + 0.095f * t, 0.05f + 0.028f * t + 0.05f * t * t, 0);
    };
    tube(b, {spout, [](float t) { return 0.021f - 0.013f * t; }, {0, 0, 1}}, along, around);
    const auto handle = [](float t) {
        const float angle = pi * (0.62f + 0.76f * t);
        return glm::vec3(-0.055f + 0.062f * std::cos(angle), 0.07f + 0.047f * std::sin(angle), 0);
    };
    tube(b, {handle, [](float) { return 0.0075f; }, {0, 0, 1}}, along, around);
    add_mesh(scene, b.take("teapot", add_surface(scene, "white glaze", {0.78f, 0.76f, 0.7f}, 0.08f)));
}

void add_bottle(Scene& scene, const Detail& detail) {
    const int bends = detail.segments(10, 4);
    Profile p{{0, 0.004f}, {0.025f, 0.004f}, {0.03f, 0}};
    add_arc(p, {0.032f, 0.008f}, 0.008f, -80, 0, bends);
    add_arc(p, {0.012f, 0.19f}, 0.028f, 0, 48, bends);
    add_arc(p, {0.064f, 0.249f}, 0.05f, 228, 180, bends);
    p.push_back({0.014f, 0.285f});
    p.push_back({0.0165f, 0.286f});
    p.push_back({0.0165f, 0.298f});
    add_arc(p, {0.0135f, 0.3f}, 0.0025f, 20, 160, 4);
    p.push_back({0.0105f, 0.27f});
    p.push_back({0, 0.262f});
    MeshBuilder b;
    lathe(b, on_table(0.2f, -0.28f), p, detail.segments(44, 14));
    add_mesh(scene, b.take("bottle", add_surface(scene, "green glass", {0.01f, 0.05f, 0.025f}, 0.05f)));
}

void add_candlestick(Scene& scene, const Detail& detail) {
    const int bends = detail.segments(8, 4), around = detail.segments(36, 12);
    Profile p{{0, 0}, {0.06f, 0}, {0.062f, 0.006f}, {0.05f, 0.012f}};
    add_arc(p, {0.05f, 0.05f}, 0.038f, 270, 190, bends);
    add_arc(p, {0.006f, 0.062f}, 0.012f, -60, 60, bends);
    p.push_back({0.008f, 0.078f});
    p.push_back({0.007f, 0.12f});
    add_arc(p, {0.006f, 0.13f}, 0.009f, -60, 60, bends);
    p.push_back({0.028f, 0.146f});
    add_arc(p, {0.03f, 0.148f}, 0.002f, -60, 120, 4);
    p.push_back({0.014f, 0.147f});
    p.push_back({0.014f, 0.162f});
    p.push_back({0.0f, 0.162f});
    MeshBuilder b, candle;
    lathe(b, on_table(0.04f, -0.3f), p, around);
    add_mesh(scene, b.take("candlestick", add_surface(scene, "brass", {0.74f, 0.55f, 0.24f}, 0.28f, 1)));
    Profile wax{{0, 0}, {0.0105f, 0}, {0.01f, 0.09f}, {0.0085f, 0.0935f}, {0.004f, 0.0915f}, {0, 0.091f}};
    lathe(candle, on_table(0.04f, -0.3f, 0.15f), wax, around);
    add_mesh(scene, candle.take("candle", add_surface(scene, "wax", {0.8f, 0.74f, 0.6f}, 0.5f)));
}

struct Thing {
    std::string name;
    glm::vec3 colour;
    float roughness, metallic;
    float x, z, radius;
};

void add_balls(Scene& scene, const Detail& detail) {
    const std::array<Thing, 7> things = {
        {{"gold", {0.9f, 0.66f, 0.28f}, 0.12f, 1, 0.18f, 0.06f, 0.062f},
         {"rough steel", {0.56f, 0.57f, 0.58f}, 0.5f, 1, 0.42f, -0.12f, 0.085f},
         {"red plastic", {0.55f, 0.03f, 0.03f}, 0.18f, 0, 0.36f, 0.12f, 0.045f},
         {"blue rubber", {0.04f, 0.1f, 0.38f}, 0.85f, 0, 0.62f, 0.06f, 0.06f},
         {"polished chrome", {0.78f, 0.78f, 0.8f}, 0.1f, 1, 0.1f, 0.32f, 0.03f},
         {"satin chrome", {0.78f, 0.78f, 0.8f}, 0.3f, 1, 0.19f, 0.335f, 0.03f},
         {"blasted chrome", {0.78f, 0.78f, 0.8f}, 0.6f, 1, 0.28f, 0.35f, 0.03f}}};
    for (const auto& t : things) {
        MeshBuilder b;
        ball(b, on_table(t.x, t.z, t.radius), t.radius, detail.segments(52, 16));
        add_mesh(scene,
                 b.take(t.name + " ball", add_surface(scene, t.name, t.colour, t.roughness, t.metallic)));
    }
}

void add_rings(Scene& scene, const Detail& detail) {
    const auto ring = [&](const Thing& t, const glm::mat4& place, float thickness) {
        const auto circle = [&](float at) {
            const float angle = 2 * pi * at;
            return glm::vec3(t.radius * std::cos(angle), 0, t.radius * std::sin(angle));
        };
        MeshBuilder b;
        b.transform = place;
        tube(b, {circle, [&](float) { return thickness; }, {0, 1, 0}, true}, detail.segments(64, 20),
             detail.segments(24, 10));
        add_mesh(scene,
                 b.take(t.name + " ring", add_surface(scene, t.name, t.colour, t.roughness, t.metallic)));
    };
    const glm::mat4 lying = glm::translate(glm::mat4(1), on_table(0.5f, 0.3f, 0.022f));
    ring({"copper", {0.88f, 0.48f, 0.33f}, 0.25f, 1, 0, 0, 0.068f}, lying, 0.022f);
    // Leans against the steel ball.
    glm::mat4 leaning = glm::translate(glm::mat4(1), on_table(0.305f, -0.2f, 0.072f));
    leaning = glm::rotate(leaning, glm::radians(-35.0f), {0, 1, 0});
    leaning = glm::rotate(leaning, glm::radians(78.0f), {0, 0, 1});
    ring({"yellow plastic", {0.75f, 0.5f, 0.04f}, 0.3f, 0, 0, 0, 0.06f}, leaning, 0.012f);
}

}  // namespace

void add_vessels(Scene& scene, const Detail& detail) {
    add_teapot(scene, detail);
    add_bottle(scene, detail);
    add_candlestick(scene, detail);
}

void add_shapes(Scene& scene, const Detail& detail) {
    add_balls(scene, detail);
    add_rings(scene, detail);
}

}  // namespace ir::scene::builtin::still_life_parts
