// The roof over the gallery: a hipped slab that falls towards the court, rafters under it, rounded tiles on
// it.

#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/atrium.h"

namespace ir::scene::builtin::atrium_parts {
namespace {

constexpr glm::vec2 eaves = court - 0.75f;  ///< half sides of the opening
constexpr glm::vec2 ridge = wall + 0.1f;    ///< half sides where the roof meets the walls
constexpr float eaves_y = 10.35f, ridge_y = 11.3f, slab = 0.22f;

/// The roof over one side, in the side's space.
struct Slope {
    const Side& side;
    float low() const { return -0.75f; }
    float high() const { return side.to_wall + 0.1f; }
    float half_at_eaves() const { return side.half() - 0.75f; }
    float half_at_ridge() const { return side.wall_half + 0.1f; }
    /// Lower face of the slab.
    float height(float z) const { return eaves_y + (ridge_y - eaves_y) * (z - low()) / (high() - low()); }
    /// Where the slope starts at x: at the eaves, or at the hip towards the corners.
    float start(float x) const {
        const float beyond = std::max(0.0f, std::abs(x) - half_at_eaves());
        return low() + (high() - low()) * beyond / (half_at_ridge() - half_at_eaves());
    }
    glm::vec3 at(float x, float z, float above) const { return {x, height(z) + above, z}; }
};

void add_rafters(MeshBuilder& b, const Slope& slope) {
    const int count = static_cast<int>(slope.side.wall_half / 0.56f);
    for (int i = -count; i <= count; ++i) {
        const float x = i * 0.56f, from = slope.start(x) + 0.06f, to = slope.side.to_wall + 0.05f;
        if (to - from > 0.5f) b.beam(slope.at(x, from, -0.07f), slope.at(x, to, -0.07f), 0.11f, 0.16f);
    }
    const float z = slope.side.to_wall - leaf_depth - 0.08f, half = slope.side.wall_half;
    b.beam({-half, slope.height(z) - 0.2f, z}, {half, slope.height(z) - 0.2f, z}, 0.16f, 0.2f);
    b.beam(slope.at(slope.half_at_eaves() + 0.05f, slope.low() + 0.05f, -0.1f),
           slope.at(slope.half_at_ridge(), slope.high(), -0.1f), 0.2f, 0.24f);
}

/// One row of tiles up the slope, each a half tube that is wider at its lower end.
void add_tile_row(MeshBuilder& b, const Slope& slope, float x, float from, float length, int segments) {
    const float to = slope.side.to_wall;
    const int tiles = std::max(1, static_cast<int>((to - from) / length));
    for (int i = 0; i < tiles; ++i) {
        const float z0 = std::lerp(from, to, float(i) / tiles), z1 = std::lerp(from, to, (i + 1.12f) / tiles);
        const auto position = [&](float u, float v) {
            const float angle = glm::radians(180 * u), radius = 0.12f - 0.03f * v;
            const float z = std::lerp(z0, std::min(z1, to + 0.1f), v);
            return slope.at(x - radius * std::cos(angle), z,
                            slab - 0.01f + 0.02f * (1 - v) + radius * std::sin(angle));
        };
        b.surface(segments, 1, position, {0.3f, 0.5f});
    }
}

void add_tiles(MeshBuilder& b, const Slope& slope, const Detail& detail) {
    const int count = static_cast<int>(slope.side.wall_half / 0.27f);
    for (int i = -count; i <= count; ++i) {
        const float x = i * 0.27f, from = slope.start(x) - 0.06f;
        if (slope.side.to_wall - from > 0.3f)
            add_tile_row(b, slope, x, from, detail.is_plain() ? 2 : 0.5f, detail.segments(4, 2));
    }
}

}  // namespace

void add_roof(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder b;
    ring(b, {ridge, eaves, ridge_y, ridge_y + slab, eaves_y, eaves_y + slab});
    for (const auto& side : sides()) {
        b.transform = side.transform;
        add_rafters(b, {side});
    }
    add_mesh(scene, b.take("roof timber", materials.wood));
    for (const auto& side : sides()) {
        b.transform = side.transform;
        add_tiles(b, {side}, detail);
    }
    add_mesh(scene, b.take("roof tiles", materials.roof));
}

}  // namespace ir::scene::builtin::atrium_parts
