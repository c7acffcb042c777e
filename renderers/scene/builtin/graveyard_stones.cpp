// Gravestones: slabs, crosses, obelisks and table tombs.

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/graveyard.h"
#include "renderers/scene/builtin/plates.h"
#include "renderers/scene/builtin/random.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin::graveyard_parts {
namespace {

constexpr float buried = 0.35f;  ///< how deep stones reach below their ground line

/// The upper part of a slab, from right to left, above `spring`.
Outline head_of(Kind kind, float half, float spring, int segments) {
    Profile head;
    switch (kind) {
        case Kind::pointed_slab: {  // two arcs around the feet of the opposite sides
            const float radius = 1.5f * half, centre = half - radius;
            const float apex = glm::degrees(std::acos(-centre / radius));
            add_arc(head, {centre, spring}, radius, 0, apex, segments);
            add_arc(head, {-centre, spring}, radius, 180 - apex, 180, segments);
            head.erase(head.begin() + segments + 1);
            break;
        }
        case Kind::shouldered_slab: {  // an arch between shoulders
            const float step = 0.24f * half, arch = half - step;
            head = {{half, spring}, {half, spring + 0.3f * half}};
            add_arc(head, {0, spring + 0.3f * half}, arch, 0, 180, 2 * segments);
            head.push_back({-half, spring + 0.3f * half});
            head.push_back({-half, spring});
            break;
        }
        default:
            add_arc(head, {0, spring}, half, 0, 180, 2 * segments);
    }
    return head;
}

Outline slab_outline(Kind kind, float half, float bottom, float spring, int segments) {
    Outline outline{{-half, bottom}, {half, bottom}};
    for (const auto& p : head_of(kind, half, spring, segments)) outline.push_back(p);
    return outline;
}

/// Raised lines, long and short by turns.
void add_inscription(MeshBuilder& b, float half, float low, float high, float face) {
    const int lines = std::max(2, static_cast<int>((high - low) / 0.085f));
    for (int i = 0; i < lines; ++i) {
        const float y = high - (static_cast<float>(i) + 0.5f) * (high - low) / lines;
        const float reach = half * (i == 0 ? 0.9f : i % 2 ? 0.7f : 0.8f);
        block(b, {-reach, y - 0.016f, face - 0.01f}, {reach, y + 0.016f, face + 0.009f}, 0.004f);
    }
}

void add_slab(MeshBuilder& b, Kind kind, const Detail& detail) {
    const float half = 0.31f, spring = 0.72f, depth = 0.075f;
    const int segments = detail.segments(8, 3);
    plate(b, {slab_outline(kind, half, -buried, spring, segments),
              -depth,
              depth,
              detail.bevel(0.014f),
              {0, 0.5f}});
    // A raised tablet of the same kind of outline.
    plate(b, {slab_outline(kind, 0.74f * half, 0.3f, spring - 0.02f, segments),
              depth - 0.02f,
              depth + 0.018f,
              detail.bevel(0.01f),
              {0, 0.5f}});
    if (detail.scale >= 0.25f) add_inscription(b, 0.6f * half, 0.36f, 0.68f, depth + 0.018f);
    lying_block(b, {-half - 0.08f, -buried, -0.17f}, {half + 0.08f, 0.09f, 0.17f}, detail.bevel(0.02f));
}

Outline cross_outline(float half, float bottom, float arm_low, float arm_high, float reach, float top) {
    return {{-half, bottom},   {half, bottom},     {half, arm_low},   {reach, arm_low},
            {reach, arm_high}, {half, arm_high},   {half, top},       {-half, top},
            {-half, arm_high}, {-reach, arm_high}, {-reach, arm_low}, {-half, arm_low}};
}

void add_cross(MeshBuilder& b, bool has_ring, const Detail& detail) {
    const float half = 0.085f, centre = 1.12f, depth = 0.075f;
    plate(b, {cross_outline(half, 0.2f, centre - half, centre + half, 0.36f, 1.52f),
              -depth,
              depth,
              detail.bevel(0.016f),
              {0, centre}});
    if (has_ring) {
        const Profile profile{{0.2f, -0.045f}, {0.255f, -0.045f}, {0.255f, 0.045f}, {0.2f, 0.045f}};
        auto frames = arc_frames({0, centre, 0}, {1, 0, 0}, {0, 0, 1}, 0, 360, detail.segments(28, 10));
        frames.back() = frames.front();
        round_moulding(b, profile, frames);
        ball(b, {0, centre, depth}, 0.06f, detail.segments(12, 6));
    }
    const float steps[3][3] = {{0.36f, -buried, 0.14f}, {0.27f, 0.13f, 0.27f}, {0.17f, 0.26f, 0.42f}};
    for (const auto& s : steps)
        lying_block(b, {-s[0], s[1], -0.72f * s[0]}, {s[0], s[2], 0.72f * s[0]}, detail.bevel(0.018f));
}

/// A square body that narrows: four-sided profiles of (half side, height), flat-shaded.
void add_tapered(MeshBuilder& b, const Profile& profile) {
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        const auto corner = [&](int side, const glm::vec2& p) {
            const glm::vec2 signs[4] = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}};
            return glm::vec3(signs[side % 4].x * p.x, p.y, signs[side % 4].y * p.x);
        };
        const glm::vec2 low = profile[i], high = profile[i + 1];
        if (low == high) continue;
        for (int side = 0; side < 4; ++side)
            b.quad(corner(side, low), corner(side + 1, low), corner(side + 1, high), corner(side, high));
    }
}

void add_obelisk(MeshBuilder& b, const Detail& detail) {
    add_tapered(b, {{0, -buried},
                    {0.36f, -buried},
                    {0.36f, 0.14f},
                    {0.33f, 0.17f},
                    {0.25f, 0.17f},
                    {0.25f, 0.5f},
                    {0.3f, 0.56f},
                    {0.3f, 0.62f},
                    {0.27f, 0.65f},
                    {0.18f, 0.65f},
                    {0.115f, 1.72f},
                    {0, 1.9f}});
    block(b, {-0.17f, 0.24f, 0.2f}, {0.17f, 0.44f, 0.265f}, detail.bevel(0.012f));
}

void add_table_tomb(MeshBuilder& b, const Detail& detail) {
    lying_block(b, {-0.48f, -buried, -0.92f}, {0.48f, 0.1f, 0.92f}, detail.bevel(0.025f));
    lying_block(b, {-0.33f, 0.08f, -0.74f}, {0.33f, 0.58f, 0.74f}, detail.bevel(0.012f));
    for (const float x : {-0.34f, 0.34f})
        for (const float z : {-0.75f, 0.75f}) {
            const float y[2] = {0.09f, 0.585f};
            lathe(b, {x, 0, z},
                  {{0, y[0]},
                   {0.1f, y[0]},
                   {0.1f, 0.16f},
                   {0.07f, 0.19f},
                   {0.07f, 0.5f},
                   {0.1f, 0.53f},
                   {0.1f, y[1]},
                   {0, y[1]}},
                  detail.segments(12, 6));
        }
    for (const float side : {-1.0f, 1.0f})
        for (const float z : {-0.36f, 0.36f})
            b.box({std::min(side * 0.3f, side * 0.355f), 0.18f, z - 0.26f},
                  {std::max(side * 0.3f, side * 0.355f), 0.48f, z + 0.26f});
    lying_block(b, {-0.47f, 0.58f, -0.9f}, {0.47f, 0.66f, 0.9f}, detail.bevel(0.02f));
    lying_block(b, {-0.4f, 0.655f, -0.83f}, {0.4f, 0.71f, 0.83f}, detail.bevel(0.022f));
}

void add_stone(MeshBuilder& b, Kind kind, const Detail& detail) {
    switch (kind) {
        case Kind::latin_cross:
            return add_cross(b, false, detail);
        case Kind::ring_cross:
            return add_cross(b, true, detail);
        case Kind::obelisk:
            return add_obelisk(b, detail);
        case Kind::table_tomb:
            return add_table_tomb(b, detail);
        default:
            return add_slab(b, kind, detail);
    }
}

/// Turned, leaning and sunk as old stones are.
glm::mat4 pose(const Plot& plot, std::uint32_t number) {
    Random random(500 + number);
    const bool is_heavy = plot.kind == Kind::table_tomb;
    const float lean = is_heavy ? 2.5f : 9;
    const float sunk = random.between(0, is_heavy ? 0.08f : 0.2f) * plot.size;
    const float yaw = random.between(-10, 10);
    const float forth = random.between(-lean, lean), sideways = random.between(-lean, lean);
    glm::mat4 m =
        glm::translate(glm::mat4(1), {plot.place.x, ground_height(plot.place) - sunk, plot.place.y});
    m = glm::rotate(m, glm::radians(yaw), {0, 1, 0});
    m = glm::rotate(m, glm::radians(forth), {1, 0, 0});
    m = glm::rotate(m, glm::radians(sideways), {0, 0, 1});
    return glm::scale(m, glm::vec3(plot.size));
}

}  // namespace

std::span<const Plot> plots() {
    using enum Kind;
    static constexpr Plot all[] = {
        // The front row, then three further back; the path from the gate stays free.
        {round_slab, {-0.9f, 3.1f}, 1.05f, 0},       {table_tomb, {2.65f, 1.75f}, 1.0f, 1},
        {latin_cross, {-2.35f, 2.4f}, 0.95f, 2},     {shouldered_slab, {-3.9f, 2.0f}, 1.1f, 1},
        {pointed_slab, {-0.55f, 1.15f}, 1.1f, 1},    {ring_cross, {-1.75f, 0.45f}, 1.1f, 0},
        {round_slab, {-3.1f, 0.3f}, 1.0f, 2},        {obelisk, {-4.35f, -0.1f}, 0.95f, 0},
        {shouldered_slab, {1.85f, -0.35f}, 1.0f, 0}, {round_slab, {3.2f, -0.75f}, 0.9f, 1},
        {latin_cross, {4.3f, 0.5f}, 1.1f, 1},        {round_slab, {-0.75f, -1.2f}, 1.15f, 1},
        {table_tomb, {-2.3f, -1.75f}, 1.0f, 0},      {pointed_slab, {-4.5f, -1.75f}, 1.1f, 2},
        {obelisk, {2.05f, -1.75f}, 1.1f, 1},         {round_slab, {5.3f, -1.2f}, 1.1f, 0},
        {pointed_slab, {-0.8f, -3.15f}, 1.1f, 0},    {latin_cross, {-2.1f, -3.55f}, 1.1f, 1},
        {shouldered_slab, {-3.35f, -3.7f}, 1.0f, 0}, {round_slab, {7.3f, -0.4f}, 0.95f, 1},
        {ring_cross, {3.0f, -3.4f}, 1.15f, 2},       {shouldered_slab, {5.0f, -3.4f}, 1.1f, 2},
        {pointed_slab, {6.6f, -2.3f}, 1.1f, 1},      {round_slab, {6.2f, 1.2f}, 1.1f, 2},
        {round_slab, {4.6f, 3.6f}, 1.0f, 0},         {latin_cross, {-4.2f, 4.3f}, 1.0f, 0},
    };
    return all;
}

void add_gravestones(Scene& scene, const Materials& materials, const Detail& detail) {
    std::array<MeshBuilder, 3> b;
    const char* names[3] = {"granite stones", "sandstone stones", "slate stones"};
    std::uint32_t number = 0;
    for (const auto& plot : plots()) {
        MeshBuilder& stones = b[plot.stone];
        stones.transform = pose(plot, number++);
        add_stone(stones, plot.kind, detail);
    }
    for (int i = 0; i < 3; ++i) add_mesh(scene, b[i].take(names[i], materials.stone[i]));
}

}  // namespace ir::scene::builtin::graveyard_parts
