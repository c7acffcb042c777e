// The brick wall, brick by brick, with a corner; the gate's piers, and gate and fence of iron bars.

#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/graveyard.h"
#include "renderers/scene/builtin/plates.h"
#include "renderers/scene/builtin/random.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin::graveyard_parts {
namespace {

constexpr float brick_length = 0.24f, brick_height = 0.071f, joint = 0.012f, foot = -0.5f,
                first_course = -0.2f;

/// Bricks are larger where there is less detail, so that there are fewer.
float brick_scale(const Detail& detail) {
    return std::clamp(1 / std::sqrt(detail.scale), 1.0f, 3.0f);
}

/// A straight wall along x from 0 to `length`, with its inner face at z = 0 and its outer one behind it.
struct Leg {
    float length, top, thickness;
    int parity;      ///< which courses reach into the corner at x = 0
    float outwards;  ///< how far they do
    std::uint32_t seed;
};

/// One brick, as deep as the wall, standing out of both faces by as much as it happens to.
void add_brick(MeshBuilder& b, glm::vec3 low, glm::vec3 high, Random& random) {
    const float unit = random.unit(), proud = 0.002f + 0.024f * unit * unit * unit;
    low.z -= random.between(0.002f, 0.014f);
    high.z += proud;
    low.y += random.between(-0.002f, 0.002f);
    const glm::vec3 cell(0.25f * static_cast<float>(random.bits() % 8),
                         0.25f * static_cast<float>(random.bits() % 8), 0);
    const glm::mat4 before = b.transform;
    const glm::vec3 centre = 0.5f * (low + high), half = 0.5f * (high - low);
    glm::mat4 m = glm::translate(before, centre);
    m = glm::rotate(m, glm::radians(random.between(-1.2f, 1.2f)), {0, 1, 0});
    m = glm::rotate(m, glm::radians(random.between(-0.5f, 0.5f)), {0, 0, 1});
    // The box lies elsewhere in its own space: that is where its texture coordinates come from.
    b.transform = glm::translate(m, -cell);
    b.box(cell - half, cell + half);
    b.transform = before;
}

void add_leg(MeshBuilder& bricks, MeshBuilder& mortar, const Leg& leg, float scale) {
    const float course = (brick_height + joint) * scale, pitch = (brick_length + joint) * scale;
    const float recess = 0.011f;
    mortar.box({-std::max(0.0f, leg.outwards - recess), foot, -leg.thickness + recess},
               {leg.length, leg.top - 0.02f, -recess});
    Random random(leg.seed);
    int row = 0;
    for (float y = first_course; y < leg.top - 0.5f * course; y += course, ++row) {
        const bool reaches = row % 2 == leg.parity;
        float x = reaches ? -leg.outwards : 0.5f * joint * scale;
        const float high = std::min(y + course - joint * scale, leg.top);
        bool is_first = true;
        while (x < leg.length - 0.03f) {
            const float jitter = random.between(-0.008f, 0.008f);
            float end = x + pitch - joint * scale + jitter;
            if (is_first && !reaches) end -= 0.5f * pitch;  // half a brick, for the bond
            end = std::min(end, leg.length);
            if (leg.length - end < 0.05f) end = leg.length;
            add_brick(bricks, {x, y, -leg.thickness}, {end, high, 0}, random);
            x = end + joint * scale;
            is_first = false;
        }
    }
}

/// Coping stones with a slope to both sides.
void add_coping(MeshBuilder& b, float from, float to, float top, float thickness, float bevel,
                std::uint32_t seed) {
    Random random(seed);
    const float over = 0.045f, wish = 0.62f;
    const int count = std::max(1, static_cast<int>(std::lround((to - from) / wish)));
    const glm::mat4 before = b.transform;
    for (int i = 0; i < count; ++i) {
        const float step = (to - from) / static_cast<float>(count), x = from + step * static_cast<float>(i);
        const float lift = random.between(0, 0.012f);
        const Outline profile{{-over, -0.02f},
                              {thickness + over, -0.02f},
                              {thickness + over, 0.055f},
                              {0.5f * thickness, 0.12f},
                              {-over, 0.055f}};
        // The profile's x points away from the viewer, its z along the wall.
        const glm::mat4 m = glm::translate(before, {x + 0.004f, top + lift, 0});
        b.transform = glm::rotate(glm::rotate(m, glm::radians(random.between(-0.6f, 0.6f)), {0, 1, 0}),
                                  pi / 2, {0, 1, 0});
        plate(b,
              {profile, 0, step - 0.008f, bevel, {0.5f * thickness, 0.04f}, {x, static_cast<float>(seed)}});
    }
    b.transform = before;
}

/// A square pier of brick with a cap and a ball.
void add_pier(MeshBuilder& bricks, MeshBuilder& mortar, MeshBuilder& stone, float x, const Detail& detail,
              std::uint32_t seed) {
    const float half = 0.22f, top = 2.25f, scale = brick_scale(detail),
                z = wall_corner.y - 0.5f * wall_thickness;
    const float course = (brick_height + joint) * scale;
    mortar.box({x - half + 0.012f, foot, z - half + 0.012f},
               {x + half - 0.012f, top - 0.01f, z + half - 0.012f});
    Random random(seed);
    int row = 0;
    const glm::mat4 before = bricks.transform;
    for (float y = first_course; y < top - 0.5f * course; y += course, ++row) {
        const float high = std::min(y + course - joint * scale, top);
        bricks.transform = glm::rotate(glm::translate(before, {x, 0, z}),
                                       0.5f * pi * static_cast<float>(row % 2), {0, 1, 0});
        for (const float s : {-1.0f, 1.0f})
            add_brick(bricks, {s < 0 ? -half : 0.5f * joint, y, -half},
                      {s < 0 ? -0.5f * joint : half, high, half}, random);
    }
    bricks.transform = before;
    lying_block(stone, {x - 0.28f, top - 0.02f, z - 0.28f}, {x + 0.28f, top + 0.09f, z + 0.28f}, 0.02f);
    lying_block(stone, {x - 0.17f, top + 0.08f, z - 0.17f}, {x + 0.17f, top + 0.15f, z + 0.17f}, 0.02f);
    ball(stone, {x, top + 0.3f, z}, 0.17f, detail.segments(20, 8));
}

// --- Iron -----------------------------------------------------------------------------------------------

void add_spike(MeshBuilder& b, glm::vec3 at, int segments) {
    lathe(b, at, {{0, 0}, {0.011f, 0}, {0.026f, 0.045f}, {0, 0.14f}}, segments);
}

/// Upright bars between two rails along x.
void add_bars(MeshBuilder& b, float from, float to, float bottom, float top, const Detail& detail,
              bool has_rings) {
    const int count = std::max(1, static_cast<int>(std::lround((to - from) / 0.135f)));
    const int segments = detail.segments(6, 4);
    const float low_rail = bottom + 0.14f, high_rail = top - 0.22f, ring_rail = high_rail - 0.14f;
    b.beam({from, low_rail, 0}, {to, low_rail, 0}, 0.014f, 0.04f);
    b.beam({from, high_rail, 0}, {to, high_rail, 0}, 0.014f, 0.04f);
    if (has_rings) b.beam({from, ring_rail, 0}, {to, ring_rail, 0}, 0.014f, 0.03f);
    const float step = (to - from) / static_cast<float>(count);
    for (int i = 0; i < count; ++i) {
        const float x = from + step * (static_cast<float>(i) + 0.5f);
        if (detail.is_plain()) {
            b.beam({x, bottom, 0}, {x, top + 0.1f, 0}, 0.017f, 0.017f, {0, 0, 1});
            continue;
        }
        bar(b, {x, bottom, 0}, {x, top, 0}, 0.0095f, segments);
        add_spike(b, {x, top - 0.005f, 0}, segments);
        if (!has_rings || i + 1 == count) continue;
        const glm::vec3 centre(x + 0.5f * step, 0.5f * (high_rail + ring_rail), 0);
        Tube ring;
        ring.curve = [=](float t) {
            return centre + 0.05f * glm::vec3(std::cos(2 * pi * t), std::sin(2 * pi * t), 0);
        };
        ring.radius = [](float) { return 0.006f; };
        ring.side = {0, 0, 1};
        ring.is_ring = true;
        tube(b, ring, detail.segments(12, 8), 4);
    }
}

/// One leaf of the gate, hinged at x = 0, with a curved upper edge of scrolls and a diagonal brace.
void add_leaf(MeshBuilder& b, float width, const Detail& detail) {
    const float bottom = 0.1f, top = 1.8f;
    for (const float x : {0.02f, width - 0.02f})
        b.beam({x, bottom, 0}, {x, top + 0.08f, 0}, 0.035f, 0.035f, {0, 0, 1});
    add_bars(b, 0.02f, width - 0.02f, bottom, top, detail, true);
    b.beam({0.02f, bottom + 0.14f, 0}, {width - 0.02f, top - 0.36f, 0}, 0.008f, 0.03f);
    ball(b, {0.02f, top + 0.11f, 0}, 0.03f, detail.segments(8, 6));
    ball(b, {width - 0.02f, top + 0.11f, 0}, 0.03f, detail.segments(8, 6));
}

glm::mat4 gate_hinge(float x, float degrees) {
    const glm::vec2 place(x, wall_corner.y - 0.5f * wall_thickness);
    return glm::rotate(glm::translate(glm::mat4(1), {place.x, ground_height({1.2f, place.y}), place.y}),
                       glm::radians(degrees), {0, 1, 0});
}

/// Turned so that x runs along the left wall towards the viewer and the inner face looks at +x.
glm::mat4 left_leg() {
    // Columns: x → +z, y → y, z → … : inner faces point to +x after a quarter turn the other way.
    glm::mat4 m(0);
    m[0] = {0, 0, -1, 0};
    m[1] = {0, 1, 0, 0};
    m[2] = {1, 0, 0, 0};
    m[3] = {wall_corner.x, 0, left_wall_end, 1};
    return m;
}

}  // namespace

void add_walls(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder bricks, mortar, stone;
    const float scale = brick_scale(detail), t = wall_thickness, bevel = detail.bevel(0.008f);
    const float pier_left = gate_left - 0.22f, pier_right = gate_right + 0.22f;
    const auto place = [&](const glm::mat4& m) { bricks.transform = mortar.transform = stone.transform = m; };
    // Behind, from the corner to the gate: its even courses lie through the corner.
    place(glm::translate(glm::mat4(1), {wall_corner.x, 0, wall_corner.y}));
    const float to_pier = pier_left - 0.2f - wall_corner.x;
    add_leg(bricks, mortar, {to_pier, wall_height, t, 0, t, 1}, scale);
    add_coping(stone, -t - 0.02f, to_pier, wall_height, t, bevel, 11);
    // On the left; here x = 0 is the near end and the corner is at x = length.
    place(left_leg());
    const float to_corner = left_wall_end - wall_corner.y;
    add_leg(bricks, mortar, {to_corner, wall_height, t, 0, 0, 2}, scale);
    add_coping(stone, 0, to_corner - 0.06f, wall_height, t, bevel, 12);
    // The plinth of the fence.
    place(glm::translate(glm::mat4(1), {pier_right + 0.2f, 0, wall_corner.y}));
    const float to_end = fence_end - pier_right - 0.2f;
    add_leg(bricks, mortar, {to_end, 0.42f, t, 0, 0, 3}, scale);
    add_coping(stone, 0, to_end, 0.42f, t, bevel, 13);
    place(glm::mat4(1));
    add_pier(bricks, mortar, stone, pier_left, detail, 4);
    add_pier(bricks, mortar, stone, pier_right, detail, 5);
    add_mesh(scene, bricks.take("bricks", materials.bricks));
    add_mesh(scene, mortar.take("mortar", materials.mortar));
    add_mesh(scene, stone.take("coping", materials.stone[1]));
}

void add_ironwork(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder b;
    const float leaf = 0.5f * (gate_right - gate_left) - 0.015f;
    b.transform = gate_hinge(gate_left, 4);
    add_leaf(b, leaf, detail);
    b.transform = gate_hinge(gate_right, 180 + 38);
    add_leaf(b, leaf, detail);
    b.transform = glm::translate(glm::mat4(1), {0, 0, wall_corner.y - 0.5f * wall_thickness});
    add_bars(b, gate_right + 0.44f, fence_end, 0.45f, 1.75f, detail, true);
    add_mesh(scene, b.take("iron", materials.iron));
}

}  // namespace ir::scene::builtin::graveyard_parts
