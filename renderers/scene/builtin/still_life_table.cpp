// The table, the cloth that hangs over its edge, and the bowl of fruit.

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/interior_textures.h"
#include "renderers/scene/builtin/solids.h"
#include "renderers/scene/builtin/still_life.h"

namespace ir::scene::builtin::still_life_parts {
namespace {

const glm::vec3 bowl_foot = table_top + glm::vec3(-0.46f, 0.005f, 0.1f);

/// Where the cloth's upper side is, `along` metres from its edge on the table; x from the table's middle.
glm::vec3 cloth_point(float x, float along) {
    const float lies = 2 * table_half.y - 0.1f, bend = 0.018f, arc = bend * pi / 2;
    const float top = table_top.y + 0.005f, edge = table_top.z + table_half.y;
    if (along < lies) return {table_top.x + x, top, edge - lies + along};
    if (along < lies + arc) {
        const float angle = (along - lies) / bend;
        return {table_top.x + x, top - bend * (1 - std::cos(angle)), edge + bend * std::sin(angle)};
    }
    const float drop = along - lies - arc;
    const float fold = std::sin(26 * x) + 0.4f * std::sin(47 * x + 1);
    const float sway = 0.03f * (1 - std::exp(-9 * drop)) * (1 + fold);
    return {table_top.x + x + 0.02f * drop * std::cos(26 * x), top - bend - drop, edge + bend + sway};
}

/// A turned body that bulges unevenly, such as an apple: radii by height from pole to pole.
Profile apple_profile(float radius, int rows) {
    Profile p;
    for (int i = 0; i <= rows; ++i) {
        const float angle = pi * (float(i) / rows - 0.5f), high = std::sin(angle);
        const float dent = 0.32f * std::exp(-14 * (1 - high)) - 0.22f * std::exp(-18 * (1 + high));
        p.push_back({radius * std::cos(angle) * (1 + 0.08f * high), radius * (0.92f * high - dent)});
    }
    p.front().x = p.back().x = 0;
    return p;
}

glm::mat4 placed(glm::vec3 at, float tilt, float turn) {
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1), at), glm::radians(turn), {0, 1, 0});
    return glm::rotate(turned, glm::radians(tilt), {1, 0, 0});
}

void add_apples(Scene& scene, const Detail& detail) {
    struct Apple {
        glm::vec3 at;
        float tilt, turn;
    };
    const std::array<Apple, 3> apples = {{{{-0.055f, 0.078f, 0.02f}, 25, 20},
                                          {{0.035f, 0.078f, 0.055f}, -30, 80},
                                          {{0.0f, 0.142f, 0.012f}, 14, 200}}};
    MeshBuilder red, green, stalks;
    const int around = detail.segments(36, 12);
    for (std::size_t i = 0; i < apples.size(); ++i) {
        MeshBuilder& b = i == 1 ? green : red;
        b.transform = stalks.transform = placed(bowl_foot + apples[i].at, apples[i].tilt, apples[i].turn);
        lathe(b, {0, 0, 0}, apple_profile(0.043f, around / 2), around);
        bar(stalks, {0, 0.02f, 0}, {0.006f, 0.048f, 0.002f}, 0.0016f, 6);
    }
    add_mesh(scene, red.take("red apples", add_surface(scene, "red apple", {0.5f, 0.05f, 0.03f}, 0.25f)));
    add_mesh(scene,
             green.take("green apple", add_surface(scene, "green apple", {0.34f, 0.48f, 0.08f}, 0.25f)));
    add_mesh(scene, stalks.take("stalks", add_surface(scene, "stalk", {0.14f, 0.08f, 0.04f}, 0.9f)));
}

void add_citrus(Scene& scene, const Detail& detail) {
    MeshBuilder b, lemon;
    const int around = detail.segments(36, 12);
    ball(b, bowl_foot + glm::vec3(0.012f, 0.078f, -0.058f), 0.042f, around);
    ball(b, bowl_foot + glm::vec3(0.235f, 0.0395f, 0.135f), 0.04f, around);
    Profile p;
    const int rows = around / 2;
    for (int i = 0; i <= rows; ++i) {
        const float angle = pi * (float(i) / rows - 0.5f);
        const float tip = std::pow(std::abs(std::sin(angle)), 9.0f);
        p.push_back(
            {0.029f * std::cos(angle), 0.036f * std::sin(angle) + std::copysign(0.009f * tip, angle)});
    }
    p.front().x = p.back().x = 0;
    lemon.transform = placed(bowl_foot + glm::vec3(0.15f, 0.027f, 0.175f), 90, 35);
    lathe(lemon, {0, 0, 0}, p, around);
    const int orange = add_textured(scene, "orange", {{}, peel()}, 0.12f, 0.4f);
    scene.materials[orange].base_colour = {0.75f, 0.26f, 0.02f, 1};
    add_mesh(scene, b.take("oranges", orange));
    add_mesh(scene, lemon.take("lemon", add_surface(scene, "lemon", {0.78f, 0.62f, 0.06f}, 0.35f)));
}

void add_bowl(Scene& scene, const Detail& detail) {
    const int bends = detail.segments(16, 6);
    Profile p{{0, 0}, {0.05f, 0}, {0.052f, 0.006f}};
    add_arc(p, {0, 0.15f}, 0.146f, -66, -14, bends);
    add_arc(p, {0.1395f, 0.1155f}, 0.0025f, -10, 170, 4);
    add_arc(p, {0, 0.15f}, 0.141f, -15, -90, bends);
    MeshBuilder b;
    lathe(b, bowl_foot - glm::vec3(0, 0.0005f, 0), p, detail.segments(56, 16));
    add_mesh(scene, b.take("bowl", add_surface(scene, "blue glaze", {0.03f, 0.14f, 0.26f}, 0.1f)));
}

}  // namespace

void add_table(Scene& scene, const Detail& detail) {
    MeshBuilder b, cloth;
    const glm::vec3 half(table_half.x, 0, table_half.y);
    slab(b, {table_top - half - glm::vec3(0, 0.035f, 0), table_top + half, 0.02f, 0.008f},
         detail.segments(4, 2));
    for (const float x : {-1.0f, 1.0f})
        for (const float z : {-1.0f, 1.0f}) {
            const glm::vec3 foot =
                glm::vec3(table_top.x, 0, table_top.z) + glm::vec3(x, 0, z) * (half - 0.07f);
            b.box(foot - glm::vec3(0.03f, 0.003f, 0.03f),
                  foot + glm::vec3(0.03f, table_top.y - 0.02f, 0.03f));
        }
    for (const float side : {-1.0f, 1.0f}) {  // rails between the legs
        const glm::vec3 in = half - 0.07f, middle = table_top - glm::vec3(0, 0.075f, 0);
        b.beam(middle + glm::vec3(-in.x, 0, side * in.z), middle + glm::vec3(in.x, 0, side * in.z), 0.022f,
               0.1f);
        b.beam(middle + glm::vec3(side * in.x, 0, -in.z), middle + glm::vec3(side * in.x, 0, in.z), 0.022f,
               0.098f);
    }
    const int oak = add_textured(
        scene, "oak", {wood("oak", {0.42f, 0.26f, 0.13f}, {0.26f, 0.14f, 0.06f}), {}}, 0.9f, 0.35f);
    add_mesh(scene, b.take("table", oak));
    const float width = 0.62f, length = 1.22f;
    const auto point = [&](float u, float v) { return cloth_point(-0.1f - width * u, length * v); };
    sheet(cloth, detail.segments(48, 12), detail.segments(72, 24), point, 0.003f, {2, 4});
    const int linen = add_textured(
        scene, "linen", {checks("linen", {0.78f, 0.74f, 0.66f}, {0.45f, 0.08f, 0.09f}), {}}, 1, 0.95f);
    add_mesh(scene, cloth.take("cloth", linen));
}

void add_fruit(Scene& scene, const Detail& detail) {
    add_bowl(scene, detail);
    add_apples(scene, detail);
    add_citrus(scene, detail);
}

}  // namespace ir::scene::builtin::still_life_parts
