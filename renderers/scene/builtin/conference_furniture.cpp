// The table with what lies on it, twelve chairs, the sideboard.

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/conference.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin::conference_parts {
namespace {

glm::mat4 turned_at(glm::vec3 place, float degrees) {
    return glm::rotate(glm::translate(glm::mat4(1), place), glm::radians(degrees), {0, 1, 0});
}

void add_table(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder b, feet;
    const int bends = detail.segments(6, 3);
    slab(b, {{-2.35f, table_top - 0.05f, -0.85f}, {2.35f, table_top, 0.85f}, 0.55f, 0.018f}, bends);
    slab(b, {{-1.9f, table_top - 0.13f, -0.5f}, {1.9f, table_top - 0.045f, 0.5f}, 0.3f, 0.01f}, bends);
    for (const float x : {-1.35f, 1.35f}) {
        slab(b, {{x - 0.32f, 0.05f, -0.28f}, {x + 0.32f, table_top - 0.12f, 0.28f}, 0.12f, 0.01f}, bends);
        slab(feet, {{x - 0.42f, -0.003f, -0.45f}, {x + 0.42f, 0.06f, 0.45f}, 0.15f, 0.02f}, bends);
    }
    add_mesh(scene, b.take("table", m.table));
    add_mesh(scene, feet.take("table feet", m.black));
}

struct ChairParts {
    MeshBuilder cushions, metal, plastic;
    void place(const glm::mat4& transform) {
        cushions.transform = metal.transform = plastic.transform = transform;
    }
};

/// Looks along -z.
void add_chair(ChairParts& b, const Detail& detail) {
    const int bends = detail.segments(4, 2), around = detail.segments(10, 5);
    const glm::mat4 place = b.cushions.transform;
    slab(b.cushions, {{-0.25f, 0.41f, -0.25f}, {0.25f, 0.5f, 0.23f}, 0.11f, 0.04f}, bends);
    b.cushions.transform =
        glm::rotate(glm::translate(place, {0, 0.56f, 0.25f}), glm::radians(-80.0f), {1, 0, 0});
    slab(b.cushions, {{-0.23f, -0.035f, 0}, {0.23f, 0.04f, 0.52f}, 0.13f, 0.035f}, bends);
    b.cushions.transform = place;
    for (const float side : {-1.0f, 1.0f}) {
        slab(b.plastic,
             {{side * 0.29f - 0.03f, 0.655f, -0.16f}, {side * 0.29f + 0.03f, 0.685f, 0.2f}, 0.028f, 0.012f},
             bends);
        bar(b.metal, {side * 0.29f, 0.67f, 0.02f}, {side * 0.29f, 0.44f, 0.02f}, 0.012f, around);
        bar(b.metal, {side * 0.3f, 0.445f, 0.02f}, {side * 0.15f, 0.445f, 0.02f}, 0.012f, around);
    }
    bar(b.metal, {0, 0.45f, 0.2f}, {0, 0.62f, 0.31f}, 0.02f, around);
    bar(b.metal, {0, 0.07f, 0}, {0, 0.42f, 0}, 0.028f, around);
    for (int i = 0; i < 5; ++i) {
        const float angle = glm::radians(72.0f * i + 18);
        const glm::vec3 out(std::cos(angle), 0, std::sin(angle));
        bar(b.metal, glm::vec3(0, 0.1f, 0), 0.31f * out + glm::vec3(0, 0.065f, 0), 0.017f, around);
        ball(b.plastic, 0.31f * out + glm::vec3(0, 0.031f, 0), 0.032f, around);
    }
}

void add_chairs(Scene& scene, const Materials& m, const Detail& detail) {
    std::array<ChairParts, 2> parts;  // by colour
    auto add = [&, number = 0](glm::vec3 place, float degrees) mutable {
        ChairParts& chair = parts[number++ % 3 == 2];
        chair.place(turned_at(place, degrees));
        add_chair(chair, detail);
    };
    const std::array<float, 10> turns = {4, -12, 3, 20, -5, 8, -3, 14, -18, 2};  // as people leave them
    for (int i = 0; i < 5; ++i) {
        const float x = -1.72f + 0.86f * i;
        add({x, 0, 1.22f + 0.02f * (i % 3)}, turns[i]);
        add({x, 0, -1.24f - 0.03f * (i % 2)}, 180 + turns[5 + i]);
    }
    add({2.72f, 0, 0.08f}, 97);
    add({-2.74f, 0, -0.05f}, -84);
    for (int i = 0; i < 2; ++i) {
        const std::string colour = i ? "green" : "red";
        add_mesh(scene, parts[i].cushions.take(colour + " cushions", m.cushions[i]));
        add_mesh(scene, parts[i].metal.take(colour + " chairs' frames", m.metal));
        add_mesh(scene, parts[i].plastic.take(colour + " chairs' arms and castors", m.black));
    }
}

Profile cup_profile(int bends) {
    Profile p{{0, 0}, {0.024f, 0}, {0.026f, 0.004f}};
    add_arc(p, {0.0f, 0.042f}, 0.04f, -50, 0, bends);
    p.push_back({0.043f, 0.07f});
    add_arc(p, {0.0415f, 0.07f}, 0.0015f, 0, 180, 3);
    add_arc(p, {0.0f, 0.042f}, 0.0372f, 0, -90, bends);
    return p;
}

void add_crockery(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder b;
    const int around = detail.segments(28, 10), bends = detail.segments(6, 3);
    const std::array<glm::vec2, 5> places = {
        {{-1.5f, 0.5f}, {-0.1f, 0.56f}, {0.95f, 0.5f}, {-0.7f, -0.55f}, {1.5f, -0.5f}}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::vec3 foot(places[i].x, table_top - 0.001f, places[i].y);
        Profile saucer{{0, 0}, {0.045f, 0}, {0.07f, 0.012f}};
        add_arc(saucer, {0.07f, 0.0135f}, 0.0015f, -60, 120, 3);
        saucer.push_back({0.042f, 0.004f});
        saucer.push_back({0, 0.004f});
        lathe(b, foot, saucer, around);
        lathe(b, foot + glm::vec3(0, 0.0035f, 0), cup_profile(bends), around);
        b.transform = turned_at(foot, 50.0f * static_cast<float>(i));
        const auto handle = [](float t) {
            const float angle = glm::radians(115 - 230 * t);
            return glm::vec3(0.044f + 0.018f * std::cos(angle), 0.044f + 0.02f * std::sin(angle), 0);
        };
        tube(b, {handle, [](float) { return 0.0035f; }, {0, 0, 1}}, detail.segments(12, 6),
             detail.segments(8, 5));
        b.transform = glm::mat4(1);
    }
    add_mesh(scene, b.take("cups", m.china));
}

void add_papers(Scene& scene, const Materials& m) {
    MeshBuilder sheets, folders;
    const std::array<glm::vec3, 8> places = {{{-1.75f, 0.62f, 8},
                                              {-0.86f, 0.6f, -6},
                                              {0.1f, 0.62f, 3},
                                              {0.8f, 0.56f, -14},
                                              {-1.6f, -0.6f, 178},
                                              {-0.1f, -0.6f, 190},
                                              {0.86f, -0.58f, 171},
                                              {1.95f, 0.05f, 95}}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const float lift = 0.0005f * static_cast<float>(i);
        sheets.transform = folders.transform =
            turned_at({places[i].x - 0.2f, table_top, places[i].y}, places[i].z);
        if (i % 3 == 1) {
            folders.box({-0.12f, -0.002f, -0.16f}, {0.12f, 0.006f, 0.16f});
            sheets.box({-0.1f, 0.004f, -0.14f}, {0.11f, 0.009f, 0.155f});
        } else {
            sheets.box({-0.105f, -0.002f, -0.148f}, {0.105f, 0.003f + lift, 0.148f});
        }
    }
    add_mesh(scene, sheets.take("papers", m.paper));
    add_mesh(scene, folders.take("folders", m.cushions[1]));
}

void add_vase(Scene& scene, const Materials& m, const Detail& detail) {
    const int around = detail.segments(36, 12), bends = detail.segments(8, 4);
    Profile p{{0, 0}, {0.055f, 0}, {0.058f, 0.006f}};
    add_arc(p, {0.02f, 0.11f}, 0.085f, -60, 55, 2 * bends);
    add_arc(p, {0.12f, 0.24f}, 0.08f, 225, 150, bends);
    add_arc(p, {0.0425f, 0.283f}, 0.004f, 20, 160, 4);
    p.push_back({0.034f, 0.24f});
    p.push_back({0, 0.1f});
    MeshBuilder b;
    lathe(b, {0.15f, table_top - 0.001f, 0.05f}, p, around);
    lathe(b, {-3.1f, 0.839f, 2.72f}, p, around);
    add_mesh(scene, b.take("vases", m.vase));
    MeshBuilder shrub;
    const std::array<glm::vec4, 5> balls = {{{0, 0.4f, 0, 0.09f},
                                             {0.07f, 0.36f, 0.03f, 0.06f},
                                             {-0.06f, 0.37f, 0.04f, 0.065f},
                                             {0.01f, 0.36f, -0.07f, 0.06f},
                                             {-0.02f, 0.47f, 0.01f, 0.055f}}};
    for (const auto& each : balls)
        ball(shrub, glm::vec3(0.15f, table_top, 0.05f) + glm::vec3(each), each.w, detail.segments(14, 8));
    bar(shrub, {0.15f, table_top + 0.12f, 0.05f}, {0.15f, table_top + 0.38f, 0.05f}, 0.012f, 6);
    add_mesh(scene, shrub.take("shrub", m.leaf));
}

void add_sideboard(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder b, handles;
    const float front = 2.52f;
    b.box({-3.5f, 0.08f, front}, {0.4f, 0.8f, 3.005f});
    b.box({-3.4f, -0.003f, front + 0.06f}, {0.3f, 0.09f, 3.004f});
    slab(b, {{-3.54f, 0.795f, front - 0.04f}, {0.44f, 0.84f, 3.02f}, 0.012f, 0.01f}, detail.segments(3, 2));
    for (int i = 0; i < 5; ++i) {
        const float x = -3.47f + 0.772f * i;
        b.box({x, 0.11f, front - 0.018f}, {x + 0.752f, 0.77f, front + 0.01f});
        const float grip = i % 2 ? x + 0.06f : x + 0.69f;
        bar(handles, {grip, 0.5f, front - 0.035f}, {grip, 0.66f, front - 0.035f}, 0.006f,
            detail.segments(8, 5));
        for (const float y : {0.52f, 0.64f})
            bar(handles, {grip, y, front - 0.037f}, {grip, y, front - 0.015f}, 0.005f, detail.segments(8, 5));
    }
    add_mesh(scene, b.take("sideboard", m.door));
    add_mesh(scene, handles.take("sideboard handles", m.metal));
}

}  // namespace

void add_furniture(Scene& scene, const Materials& m, const Detail& detail) {
    add_table(scene, m, detail);
    add_chairs(scene, m, detail);
    add_crockery(scene, m, detail);
    add_papers(scene, m);
    add_vase(scene, m, detail);
    add_sideboard(scene, m, detail);
}

}  // namespace ir::scene::builtin::conference_parts
