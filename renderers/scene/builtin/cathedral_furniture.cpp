// Floor and steps, benches, altar, pulpit and chandeliers.

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/cathedral.h"
#include "renderers/scene/builtin/plates.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin::cathedral_parts {
namespace {

constexpr int rows_of_benches = 16;

void add_floor(MeshBuilder& tiles, MeshBuilder& marble) {
    tiles.box({-nave_end - 0.9f, -0.3f, -outside}, {nave_end + nave + 1, 0, outside});
    const float step = choir_height / 3;
    for (int i = 0; i < 3; ++i) {
        const float x = choir_from + 0.36f * static_cast<float>(i);
        lying_block(marble, {x, -0.02f, -nave + 0.02f},
                    {nave_end + 0.2f, step * static_cast<float>(i + 1), nave - 0.02f}, 0.015f);
    }
    // Two more for the altar, as deep as the apse.
    for (int i = 0; i < 2; ++i) {
        const float inset = 0.4f * static_cast<float>(i);
        Outline outline{{nave_end - 1.2f + inset, -nave + 0.05f + inset}};
        add_arc(outline, {nave_end, 0}, nave - 0.3f - 0.3f * inset, -80, 80, 5);
        outline.push_back({nave_end - 1.2f + inset, nave - 0.05f - inset});
        lying_plate(
            marble,
            {outline, -0.02f, choir_height + 0.15f * static_cast<float>(i + 1), 0.015f, {nave_end, 0}});
    }
}

/// A bench with its kneeler; people look at +x. z from `low` to `high`.
void add_bench(MeshBuilder& b, float x, float low, float high, const Detail& detail) {
    lying_block(b, {x, 0.41f, low}, {x + 0.38f, 0.45f, high}, 0.008f);
    const glm::mat4 before = b.transform;
    b.transform = glm::rotate(glm::translate(before, {x + 0.02f, 0.43f, 0}), glm::radians(7.0f), {0, 0, 1});
    b.box({-0.035f, 0, low}, {0, 0.48f, high});
    lying_block(b, {-0.075f, 0.47f, low - 0.02f}, {0.02f, 0.51f, high + 0.02f}, 0.01f);
    b.transform = before;
    lying_block(b, {x - 0.5f, 0.16f, low + 0.03f}, {x - 0.32f, 0.2f, high - 0.03f}, 0.01f);
    for (const float z : {low, high}) {
        Outline end{{-0.12f, -0.01f}, {0.42f, -0.01f}, {0.42f, 0.5f}};
        if (!detail.is_plain()) add_arc(end, {0.33f, 0.56f}, 0.09f, -30, 120, detail.segments(5, 2));
        add_arc(end, {0.06f, 0.93f}, 0.14f, 0, 180, detail.segments(8, 2));
        end.push_back({-0.12f, 0.5f});
        b.transform = glm::translate(before, {x, 0, z});
        plate(b, {end, -0.03f, 0.03f, detail.is_plain() ? 0 : 0.01f, {0.1f, 0.5f}});
        b.transform = before;
    }
}

void add_benches(MeshBuilder& b, const Detail& detail) {
    for (int i = 0; i < rows_of_benches; ++i) {
        const float x = -9.6f + 0.98f * static_cast<float>(i);
        add_bench(b, x, 0.85f, 3.25f, detail);
        add_bench(b, x, -3.25f, -0.85f, detail);
    }
}

void add_candlestick(MeshBuilder& metal, MeshBuilder& wax, glm::vec3 foot, float height,
                     const Detail& detail) {
    const float h = height;
    const int segments = detail.segments(12, 4);
    lathe(metal, foot,
          {{0, 0},
           {0.11f, 0},
           {0.1f, 0.03f},
           {0.04f, 0.06f},
           {0.022f, 0.12f},
           {0.022f, 0.45f * h},
           {0.05f, 0.5f * h},
           {0.022f, 0.55f * h},
           {0.022f, 0.92f * h},
           {0.07f, h},
           {0, h}},
          segments);
    bar(wax, foot + glm::vec3(0, h - 0.01f, 0), foot + glm::vec3(0, h + 0.32f, 0), 0.02f, segments);
}

void add_altar(MeshBuilder& marble, MeshBuilder& metal, MeshBuilder& wax, MeshBuilder& cloth,
               const Detail& detail) {
    const float floor = choir_height + 0.3f, x = nave_end + 1.1f;
    lying_block(marble, {x - 0.4f, floor - 0.02f, -1.25f}, {x + 0.4f, floor + 0.1f, 1.25f}, 0.02f);
    block(marble, {x - 0.32f, floor + 0.08f, -1.1f}, {x + 0.32f, floor + 0.92f, 1.1f}, 0.02f);
    lying_block(marble, {x - 0.46f, floor + 0.9f, -1.35f}, {x + 0.46f, floor + 1.0f, 1.35f}, 0.02f);
    for (const float z : {-0.8f, 0.0f, 0.8f})
        marble.box({x - 0.36f, floor + 0.2f, z - 0.3f}, {x - 0.3f, floor + 0.8f, z + 0.3f});
    cloth.box({x - 0.47f, floor + 0.62f, -0.55f}, {x - 0.462f, floor + 1.008f, 0.55f});
    cloth.box({x - 0.47f, floor + 0.99f, -0.55f}, {x + 0.4f, floor + 1.009f, 0.55f});
    for (const float z : {-1.1f, -0.8f, 0.8f, 1.1f})
        add_candlestick(metal, wax, {x + 0.1f, floor + 1, z}, 0.4f, detail);
    // A standing cross.
    metal.box({x + 0.07f, floor + 0.99f, -0.2f}, {x + 0.33f, floor + 1.06f, 0.2f});
    const float c = floor + 1.95f, r = 0.045f;
    const glm::mat4 before = metal.transform;
    metal.transform =
        glm::rotate(glm::translate(before, {x + 0.2f, 0, 0}), -glm::half_pi<float>(), {0, 1, 0});
    plate(metal, {{{-r, floor + 1.05f},
                   {r, floor + 1.05f},
                   {r, c - r},
                   {0.34f, c - r},
                   {0.34f, c + r},
                   {r, c + r},
                   {r, c + 0.42f},
                   {-r, c + 0.42f},
                   {-r, c + r},
                   {-0.34f, c + r},
                   {-0.34f, c - r},
                   {-r, c - r}},
                  -0.03f,
                  0.03f,
                  0.01f,
                  {0, c}});
    metal.transform = before;
    for (const float z : {-2.2f, 2.2f})
        add_candlestick(metal, wax, {nave_end - 0.4f, choir_height + 0.3f, z}, 1.3f, detail);
}

/// Eight-sided, upon a stem, with a sounding board above, before a pier.
void add_pulpit(MeshBuilder& b, MeshBuilder& stone, const Detail& detail) {
    const glm::vec3 foot(pier_axis(4), 0, nave - 0.75f);
    lathe(stone, foot,
          {{0, -0.02f},
           {0.4f, -0.02f},
           {0.4f, 0.15f},
           {0.24f, 0.25f},
           {0.16f, 0.4f},
           {0.16f, 1.1f},
           {0.22f, 1.2f},
           {0.5f, 1.55f},
           {0.62f, 1.62f},
           {0, 1.62f}},
          detail.segments(16, 8));
    const auto eight = [](float radius) {
        Outline outline;
        for (int i = 0; i < 8; ++i) {
            const float angle = 2 * pi * (static_cast<float>(i) + 0.5f) / 8;
            outline.push_back(radius * glm::vec2(std::cos(angle), std::sin(angle)));
        }
        return outline;
    };
    b.transform = glm::translate(glm::mat4(1), foot);
    lying_plate(b, {eight(0.68f), 1.6f, 1.7f, 0.02f});
    lying_plate(b, {eight(0.6f), 1.68f, 2.55f, 0});
    lying_plate(b, {eight(0.7f), 2.53f, 2.63f, 0.02f});
    lying_plate(b, {eight(0.85f), 3.5f, 3.62f, 0.03f});
    lying_plate(b, {eight(0.7f), 3.6f, 3.75f, 0.03f});
    for (int i = 0; i < 8; ++i) {
        b.transform =
            glm::rotate(glm::translate(glm::mat4(1), foot), 2 * pi * static_cast<float>(i) / 8, {0, 1, 0});
        block(b, {-0.17f, 1.8f, 0.5f}, {0.17f, 2.42f, 0.585f}, 0.02f);
    }
    b.transform = glm::mat4(1);
    b.box(foot + glm::vec3(-0.3f, 2.6f, 0.25f), foot + glm::vec3(0.3f, 3.52f, 0.42f));
}

void add_chandelier(MeshBuilder& metal, MeshBuilder& wax, float x, const Detail& detail) {
    const float y = 5.1f, radius = 0.85f;
    constexpr int candles = 12;
    auto frames = arc_frames({x, y, 0}, {1, 0, 0}, {0, 1, 0}, 0, 360, detail.segments(36, 12));
    frames.back() = frames.front();
    round_moulding(metal,
                   {{radius - 0.03f, -0.05f},
                    {radius + 0.03f, -0.05f},
                    {radius + 0.03f, 0.05f},
                    {radius - 0.03f, 0.05f}},
                   frames);
    bar(metal, {x, y + 1.3f, 0}, {x, vault_spring + vault_rise - 0.1f, 0}, 0.014f, 5);
    ball(metal, {x, y + 1.3f, 0}, 0.09f, detail.segments(10, 6));
    for (int i = 0; i < candles; ++i) {
        const float angle = 2 * pi * static_cast<float>(i) / candles;
        const glm::vec3 at(x + radius * std::cos(angle), y, radius * std::sin(angle));
        if (i % 3 == 0) bar(metal, at, {x, y + 1.3f, 0}, 0.012f, 4);
        lathe(metal, at, {{0, 0.02f}, {0.03f, 0.02f}, {0.06f, 0.09f}, {0, 0.09f}}, 6);
        bar(wax, at + glm::vec3(0, 0.08f, 0), at + glm::vec3(0, 0.26f, 0), 0.018f, 6);
    }
}

}  // namespace

void add_furniture(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder tiles, marble, wood, metal, wax, cloth;
    add_floor(tiles, marble);
    add_benches(wood, detail);
    add_altar(marble, metal, wax, cloth, detail);
    add_pulpit(wood, marble, detail);
    for (const int i : {0, 2, 4}) add_chandelier(metal, wax, bay_middle(i), detail);
    add_mesh(scene, tiles.take("floor", materials.tiles));
    add_mesh(scene, marble.take("steps and altar", materials.marble));
    add_mesh(scene, wood.take("benches and pulpit", materials.wood));
    add_mesh(scene, metal.take("bronze", materials.bronze));
    add_mesh(scene, wax.take("candles", materials.wax));
    add_mesh(scene, cloth.take("altar cloth", materials.cloth));
}

}  // namespace ir::scene::builtin::cathedral_parts
