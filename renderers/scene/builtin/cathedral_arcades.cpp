// The walls along nave and aisles: arcade, triforium, clerestory, and the outer wall with a blind arcade.

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/scene/builtin/cathedral.h"
#include "renderers/scene/builtin/plates.h"

namespace ir::scene::builtin::cathedral_parts {
namespace {

/// Where a panel's front is, and which way along the nave.
glm::mat4 panel_at(const glm::mat4& side, float x, float z) {
    return glm::translate(side, {x, 0, z});
}

/// A roll around a round arch in the plane of x and y, `radius` from its centre to the roll's.
void add_roll(MeshBuilder& b, glm::vec3 centre, float radius, float thickness, int segments) {
    const float t = thickness;
    const Profile profile{{radius - 0.9f * t, -0.6f * t},
                          {radius + 0.1f * t, -t},
                          {radius + t, 0},
                          {radius + 0.1f * t, t},
                          {radius - 0.9f * t, 0.6f * t}};
    moulding(b, profile, arc_frames(centre, {1, 0, 0}, {0, 0, -1}, 0, 180, segments));
}

/// A string course along x: its profile is (distance out of the wall, height).
void add_course(MeshBuilder& b, float from, float to, float y, float z, float out, float size) {
    const float s = size;
    const Profile profile{{-0.05f, -0.5f * s}, {0.25f * s, -0.5f * s}, {0.45f * s, -0.15f * s}, {s, 0.1f * s},
                          {s, 0.4f * s},       {0.3f * s, 0.6f * s},   {-0.05f, 0.6f * s}};
    moulding(b, profile, {{{from, y, z}, {0, 0, out}, {0, 1, 0}}, {{to, y, z}, {0, 0, out}, {0, 1, 0}}});
}

void add_colonnette(MeshBuilder& b, glm::vec3 foot, float height, float r, int segments) {
    const float h = height;
    const Profile profile{{0, 0},
                          {2 * r, 0},
                          {2 * r, r},
                          {1.4f * r, 1.9f * r},
                          {r, 2.4f * r},
                          {r, h - 3.4f * r},
                          {1.9f * r, h - 0.9f * r},
                          {2 * r, h},
                          {0, h}};
    lathe(b, foot, profile, segments);
}

void add_arcade(MeshBuilder& wall, MeshBuilder& trim, const glm::mat4& side, int i, const Detail& detail) {
    const float x = bay_middle(i);
    const int segments = detail.segments(22, 5);
    wall.transform = panel_at(side, x, arcade_back);
    arched_panel(
        wall,
        {bay, arcade_spring, arcade_top, arcade_spring, arcade_spring, arcade_radius, arcade_back - nave},
        segments);
    trim.transform = side;
    for (const float z : {nave, arcade_back}) {
        const float out = z == nave ? -1.0f : 1.0f;
        add_roll(trim, {x, arcade_spring, z - 0.16f * out}, arcade_radius, 0.085f, segments);
        if (detail.is_plain()) continue;
        add_roll(trim, {x, arcade_spring, z + 0.01f * out}, arcade_radius + 0.14f, 0.06f, segments);
        if (z == nave)
            add_roll(trim, {x, arcade_spring, z + 0.03f * out}, arcade_radius + 0.42f, 0.055f, segments);
    }
}

void add_triforium(MeshBuilder& wall, MeshBuilder& trim, const glm::mat4& side, int i, const Detail& detail) {
    constexpr int arches = 3;
    const float width = bay / arches, sill = arcade_top + 0.22f, spring = 7.5f;
    const int segments = detail.segments(12, 4);
    for (int k = 0; k < arches; ++k) {
        const float x = bay_middle(i) + (static_cast<float>(k) - 1) * width;
        wall.transform = panel_at(side, x, nave + 0.25f);
        arched_panel(wall, {width, arcade_top, triforium_top, sill, spring, 0.52f, 0.25f}, segments);
        trim.transform = side;
        if (!detail.is_plain()) add_roll(trim, {x, spring, nave - 0.01f}, 0.6f, 0.045f, segments);
        for (const float s : {-1.0f, 1.0f})
            add_colonnette(trim, {x + s * 0.6f, sill, nave - 0.02f}, spring - sill, 0.055f,
                           detail.segments(8, 5));
    }
    wall.transform = side;
    wall.box({pier_axis(i), arcade_top, arcade_back - 0.15f}, {pier_axis(i + 1), triforium_top, arcade_back});
}

/// Stone bars and a ring in a window whose opening is centred on x.
void add_tracery(MeshBuilder& b, glm::vec3 foot, float height, float radius, const Detail& detail) {
    const float ring = 0.42f * radius;
    const glm::vec3 centre = foot + glm::vec3(0, height + 0.42f * radius, 0);
    const Profile profile{
        {ring - 0.04f, -0.05f}, {ring + 0.04f, -0.05f}, {ring + 0.04f, 0.05f}, {ring - 0.04f, 0.05f}};
    auto frames = arc_frames(centre, {1, 0, 0}, {0, 0, -1}, 0, 360, detail.segments(16, 5));
    frames.back() = frames.front();
    round_moulding(b, profile, frames);
    block(b, foot + glm::vec3(-0.05f, -0.02f, -0.05f),
          foot + glm::vec3(0.05f, height - 0.02f + 0.02f * radius, 0.05f), 0.015f);
    for (const float s : {-1.0f, 1.0f}) {
        const float half = 0.5f * radius;
        moulding(b, {{half - 0.07f, -0.04f}, {half, -0.04f}, {half, 0.04f}, {half - 0.07f, 0.04f}},
                 arc_frames(foot + glm::vec3(s * half, height - half, 0), {1, 0, 0}, {0, 0, -1}, 0, 180,
                            detail.segments(10, 4)));
    }
}

void add_clerestory(MeshBuilder& wall, MeshBuilder& trim, const glm::mat4& side, int i,
                    const Detail& detail) {
    const float x = bay_middle(i), sill = 9.2f, spring = 11.1f, radius = 0.85f;
    const int segments = detail.segments(16, 5);
    wall.transform = panel_at(side, x, arcade_back);
    arched_panel(wall, {bay, triforium_top, vault_top, sill, spring, radius, arcade_back - nave}, segments);
    trim.transform = side;
    add_roll(trim, {x, spring, nave}, radius + 0.1f, 0.07f, segments);
    for (const float s : {-1.0f, 1.0f})
        add_colonnette(trim, {x + s * (radius + 0.1f), sill, nave - 0.01f}, spring - sill, 0.06f,
                       detail.segments(8, 5));
    add_tracery(trim, {x, sill, nave + 0.4f}, spring - sill, radius, detail);
}

void add_outer_wall(MeshBuilder& wall, MeshBuilder& trim, const glm::mat4& side, int i,
                    const Detail& detail) {
    const float x = bay_middle(i), sill = 2.15f, spring = 3.6f, radius = 0.8f;
    const int segments = detail.segments(16, 5);
    wall.transform = panel_at(side, x, outside);
    arched_panel(wall, {bay, -0.05f, aisle_top, sill, spring, radius, outside - aisle}, segments);
    trim.transform = side;
    add_roll(trim, {x, spring, aisle}, radius + 0.1f, 0.07f, segments);
    add_tracery(trim, {x, sill, aisle + 0.45f}, spring - sill, radius, detail);
    constexpr int arches = 4;
    for (int k = 0; k < arches; ++k) {  // a blind arcade upon a bench
        const float width = (bay - 0.7f) / arches;
        const float at = x + (static_cast<float>(k) - 1.5f) * width;
        wall.transform = panel_at(side, at, aisle + 0.01f);
        arched_panel(wall, {width, 0.42f, 1.75f, 0.42f, 1.15f, 0.36f, 0.17f}, detail.segments(10, 4));
        if (k > 0)
            add_colonnette(trim, {at - 0.5f * width, 0.42f, aisle - 0.18f}, 0.73f, 0.05f,
                           detail.segments(10, 4));
    }
    wall.transform = side;
    for (const float s : {-1.0f, 1.0f}) {  // ends of the blind arcade
        const float end = x + s * 0.5f * (bay - 0.7f);
        wall.box({end - 0.06f, 0.4f, aisle - 0.19f}, {end + 0.06f, 1.78f, aisle + 0.02f});
    }
    trim.transform = side;
    lying_block(trim, {x - 0.5f * bay + 0.3f, -0.02f, aisle - 0.42f},
                {x + 0.5f * bay - 0.3f, 0.43f, aisle + 0.02f}, 0.03f);
}

}  // namespace

glm::mat4 side_transform(int side) {
    return side ? glm::mat4(glm::vec4(-1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, -1, 0),
                            glm::vec4(0, 0, 0, 1))
                : glm::mat4(1);
}

void add_arcades(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder wall, trim;
    for (int s = 0; s < 2; ++s) {
        const glm::mat4 side = side_transform(s);
        for (int i = 0; i < bays; ++i) {
            add_arcade(wall, trim, side, i, detail);
            add_triforium(wall, trim, side, i, detail);
            add_clerestory(wall, trim, side, i, detail);
            add_outer_wall(wall, trim, side, i, detail);
        }
        trim.transform = side;
        add_course(trim, -nave_end, nave_end, arcade_top, nave, -1, 0.16f);
        add_course(trim, -nave_end, nave_end, triforium_top, nave, -1, 0.16f);
        add_course(trim, -nave_end, nave_end, 1.95f, aisle, -1, 0.14f);
    }
    add_mesh(scene, wall.take("walls", materials.stone));
    add_mesh(scene, trim.take("mouldings", materials.pale));
}

}  // namespace ir::scene::builtin::cathedral_parts
