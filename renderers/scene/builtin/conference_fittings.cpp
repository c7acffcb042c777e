// Windows with blinds, the door, the board and what hangs on the walls.

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/conference.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin::conference_parts {
namespace {

/// Four beams around a rectangle in the plane of x and y; those upright stand a millimetre further out, so
/// that no two lie in one plane.
void add_frame(MeshBuilder& b, glm::vec2 low, glm::vec2 high, float z, float width, float depth) {
    for (const float x : {low.x, high.x})
        b.box({x - width / 2, low.y - width / 2, z}, {x + width / 2, high.y + width / 2, z + depth + 0.001f});
    for (const float y : {low.y, high.y})
        b.box({low.x - 0.01f, y - width / 2 + 0.001f, z + 0.001f},
              {high.x + 0.01f, y + width / 2 - 0.001f, z + depth});
}

void add_slats(MeshBuilder& b, float x, int count) {
    const glm::mat4 before = b.transform;
    for (int i = 0; i < count; ++i) {
        b.transform = glm::translate(before, {x, 2.32f - 0.035f * i, room_low.z + 0.035f});
        b.transform = glm::rotate(b.transform, glm::radians(38.0f), {1, 0, 0});
        b.box({-0.93f, -0.0015f, -0.022f}, {0.93f, 0.0015f, 0.022f});
    }
    b.transform = before;
    b.box({x - 0.95f, 2.345f, room_low.z - 0.01f}, {x + 0.95f, 2.4f, room_low.z + 0.07f});
    const float bottom = 2.32f - 0.035f * count;
    b.box({x - 0.93f, bottom - 0.015f, room_low.z + 0.02f}, {x + 0.93f, bottom + 0.005f, room_low.z + 0.05f});
}

void add_windows(Scene& scene, const Materials& m) {
    MeshBuilder panes, frames, blinds, sills;
    const float back = room_low.z - 0.12f;
    int number = 0;
    for (const float x : {-2.7f, 0.0f, 2.7f}) {
        panes.box({x - 0.91f, 0.94f, back - 0.01f}, {x + 0.91f, 2.36f, back + 0.012f});
        add_frame(frames, {x - 0.88f, 0.97f}, {x + 0.88f, 2.33f}, back + 0.005f, 0.07f, 0.05f);
        frames.box({x - 0.03f, 0.98f, back + 0.004f}, {x + 0.03f, 2.32f, back + 0.052f});
        add_slats(blinds, x, 14 + 9 * (number++ % 2));
        sills.box({x - 0.95f, 0.92f, back + 0.02f}, {x + 0.95f, 0.955f, room_low.z + 0.09f});
    }
    add_mesh(scene, panes.take("window panes", m.pane));
    add_mesh(scene, frames.take("window frames", m.metal));
    add_mesh(scene, blinds.take("blinds", m.blind));
    add_mesh(scene, sills.take("sills", m.panelling));
}

void add_door(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder leaf, metal;
    const float z = room_high.z;
    leaf.box({2.495f, 0.006f, z + 0.03f}, {3.505f, 2.105f, z + 0.09f});
    for (const float y : {0.18f, 1.12f})  // raised panels
        leaf.box({2.68f, y, z + 0.018f}, {3.32f, y + 0.8f, z + 0.04f});
    leaf.box({2.42f, -0.002f, z - 0.02f}, {2.5f, 2.18f, z + 0.05f});
    leaf.box({3.5f, -0.002f, z - 0.02f}, {3.58f, 2.18f, z + 0.05f});
    leaf.box({2.49f, 2.1f, z - 0.019f}, {3.51f, 2.179f, z + 0.05f});
    add_mesh(scene, leaf.take("door", m.door));
    const int around = detail.segments(12, 6);
    bar(metal, {2.6f, 1.03f, z + 0.035f}, {2.6f, 1.03f, z - 0.035f}, 0.009f, around);
    bar(metal, {2.595f, 1.03f, z - 0.03f}, {2.73f, 1.03f, z - 0.03f}, 0.009f, around);
    metal.box({2.575f, 0.93f, z + 0.022f}, {2.625f, 1.09f, z + 0.035f});
    add_mesh(scene, metal.take("door handle", m.metal));
}

void add_board(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder board, metal, pens;
    // In its space the board lies in the plane of x and y; z points into the room.
    const glm::mat4 on_wall =
        glm::rotate(glm::translate(glm::mat4(1), {room_low.x, 0, -0.1f}), glm::radians(90.0f), {0, 1, 0});
    board.transform = metal.transform = pens.transform = on_wall;
    board.box({-1.3f, 0.95f, -0.01f}, {1.3f, 2.15f, 0.022f});
    add_frame(metal, {-1.3f, 0.95f}, {1.3f, 2.15f}, -0.005f, 0.035f, 0.04f);
    metal.box({-0.6f, 0.905f, -0.01f}, {0.6f, 0.925f, 0.11f});
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 from(-0.4f + 0.22f * i, 0.935f, 0.055f + 0.008f * i);
        bar(pens, from, from + glm::vec3(0.13f, 0, 0.01f * i), 0.011f, detail.segments(12, 6));
    }
    add_mesh(scene, board.take("board", m.board));
    add_mesh(scene, metal.take("board frame", m.metal));
    add_mesh(scene, pens.take("pens", m.black));
}

/// Wood along the wall opposite the board, in raised fields.
void add_panelling(Scene& scene, const Materials& m, const Detail& detail) {
    MeshBuilder b;
    b.transform =
        glm::rotate(glm::translate(glm::mat4(1), {room_high.x, 0, 0}), glm::radians(-90.0f), {0, 1, 0});
    b.box({-2.99f, 0.1f, -0.01f}, {2.99f, 2.3f, 0.02f});
    b.box({-2.995f, 2.28f, -0.01f}, {2.995f, 2.33f, 0.045f});
    const glm::mat4 wall_space = b.transform;
    const int bends = detail.segments(3, 2);
    for (int i = 0; i < 6; ++i)
        for (const glm::vec2 rows : {glm::vec2(0.18f, 1.0f), glm::vec2(1.08f, 2.2f)}) {
            // A slab lies flat: it is turned up so that its top looks into the room.
            b.transform = glm::rotate(glm::translate(wall_space, {-2.5f + i, rows.x, 0.01f}),
                                      glm::radians(90.0f), {1, 0, 0});
            slab(b, {{-0.43f, 0, -(rows.y - rows.x)}, {0.43f, 0.028f, 0}, 0.03f, 0.012f}, bends);
        }
    add_mesh(scene, b.take("panelling", m.panelling));
}

void add_skirting(Scene& scene, const Materials& m) {
    MeshBuilder b;
    const glm::vec3 lo = room_low, hi = room_high;
    b.box({lo.x - 0.01f, -0.005f, lo.z - 0.01f}, {hi.x + 0.01f, 0.09f, lo.z + 0.016f});
    b.box({lo.x - 0.01f, -0.005f, hi.z - 0.016f}, {2.43f, 0.09f, hi.z + 0.01f});
    b.box({3.57f, -0.005f, hi.z - 0.016f}, {hi.x + 0.01f, 0.09f, hi.z + 0.01f});
    b.box({lo.x - 0.01f, -0.005f, lo.z + 0.006f}, {lo.x + 0.016f, 0.091f, hi.z - 0.006f});
    b.box({hi.x - 0.016f, -0.005f, lo.z + 0.006f}, {hi.x + 0.01f, 0.091f, hi.z - 0.006f});
    add_mesh(scene, b.take("skirting", m.table));
}

void add_picture(Scene& scene, const Materials& m) {
    MeshBuilder picture, frame;
    picture.transform = frame.transform = glm::rotate(
        glm::translate(glm::mat4(1), {-1.5f, 1.35f, room_high.z}), glm::radians(180.0f), {0, 1, 0});
    picture.box({-0.6f, 0, -0.01f}, {0.6f, 0.8f, 0.015f});
    add_frame(frame, {-0.6f, 0}, {0.6f, 0.8f}, -0.005f, 0.05f, 0.035f);
    add_mesh(scene, picture.take("picture", m.picture));
    add_mesh(scene, frame.take("picture frame", m.table));
}

}  // namespace

void add_fittings(Scene& scene, const Materials& m, const Detail& detail) {
    add_windows(scene, m);
    add_door(scene, m, detail);
    add_board(scene, m, detail);
    add_panelling(scene, m, detail);
    add_skirting(scene, m);
    add_picture(scene, m);
}

}  // namespace ir::scene::builtin::conference_parts
