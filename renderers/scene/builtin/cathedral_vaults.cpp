// Groin vaults with ribs over nave and aisles, as closed bodies with a flat top.

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/cathedral.h"
#include "renderers/scene/builtin/plates.h"

namespace ir::scene::builtin::cathedral_parts {
namespace {

/// A row of vaults along x.
struct Row {
    float low, high;  ///< z
    float spring, rise, top;
    float middle_z() const { return 0.5f * (low + high); }
};

/// The wall above one side of a vault, between its arch and the flat top; `way` leads along the side with the
/// outside on its right.
void add_upper_side(MeshBuilder& b, glm::vec3 middle, glm::vec3 half_way, const Row& row, int segments) {
    const glm::vec3 normal = glm::normalize(glm::cross(half_way, glm::vec3(0, 1, 0)));
    b.grid(2 * segments, 1, [&](float u, float v) {
        const float s = std::sin(pi / 2 * (2 * u - 1));
        glm::vec3 p = middle + s * half_way;
        p.y = v > 0.5f ? row.top : row.spring + row.rise * std::sqrt(std::max(0.0f, 1 - s * s));
        return Vertex{p, normal, {s, p.y}};
    });
}

/// The flat top over one side: a fan around the middle of the bay.
void add_top(MeshBuilder& b, glm::vec3 centre, glm::vec3 middle, glm::vec3 half_way, float top,
             int segments) {
    b.grid(2 * segments, 1, [&](float u, float v) {
        const float s = std::sin(pi / 2 * (2 * u - 1));
        glm::vec3 p = v > 0.5f ? centre : middle + s * half_way;
        p.y = top;
        return Vertex{p, {0, 1, 0}, {p.x, p.z}};
    });
}

void add_webs(MeshBuilder& b, const Row& row, int segments) {
    const float half_x = 0.5f * bay, half_z = 0.5f * (row.high - row.low);
    for (int i = 0; i < bays; ++i) {
        const float x = bay_middle(i);
        const glm::vec3 centre(x, 0, row.middle_z());
        groin_vault(b, {x - half_x, row.low}, {x + half_x, row.high}, row.spring, row.rise, segments);
        struct Side {
            glm::vec3 out, way;
            bool is_open;
        };
        const Side sides[4] = {{{0, 0, half_z}, {half_x, 0, 0}, true},
                               {{0, 0, -half_z}, {-half_x, 0, 0}, true},
                               {{half_x, 0, 0}, {0, 0, -half_z}, i + 1 == bays},
                               {{-half_x, 0, 0}, {0, 0, half_z}, i == 0}};
        for (const auto& side : sides) {
            add_top(b, centre, centre + side.out, side.way, row.top, segments);
            if (side.is_open) add_upper_side(b, centre + side.out, side.way, row, segments);
        }
    }
}

void add_boss(MeshBuilder& b, glm::vec3 at, float radius, int segments) {
    const Profile profile{{0, -0.75f}, {0.35f, -0.7f}, {0.5f, -0.5f}, {0.85f, -0.45f},
                          {1, -0.2f},  {0.9f, 0},      {1, 0.3f},     {0, 0.3f}};
    Profile scaled;
    for (const auto& p : profile) scaled.push_back(radius * p);
    lathe(b, at, scaled, segments);
}

void add_ribs(MeshBuilder& b, const Row& row, float width, const Detail& detail) {
    const int segments = detail.segments(14, 4);
    const float half_x = 0.5f * bay;
    for (int i = 0; i < bays; ++i) {
        const float x = bay_middle(i), y = row.spring;
        const glm::vec3 corners[4] = {{x - half_x, y, row.low},
                                      {x + half_x, y, row.low},
                                      {x + half_x, y, row.high},
                                      {x - half_x, y, row.high}};
        for (int k = 0; k < 2; ++k) {
            add_rib(b, {corners[k], corners[k + 2], row.rise}, width, segments);
            if (!detail.is_plain())
                add_rib(b, {corners[2 * k], corners[2 * k + 1], row.rise}, 0.6f * width, segments);
        }
        add_rib(b, {corners[0], corners[3], row.rise}, 1.5f * width, segments);
        if (i + 1 == bays) add_rib(b, {corners[1], corners[2], row.rise}, 1.5f * width, segments);
        add_boss(b, {x, y + row.rise - 0.12f, row.middle_z()}, 1.5f * width, detail.segments(10, 4));
    }
}

}  // namespace

std::vector<BowFrame> bow_points(const Bow& bow, int segments) {
    const glm::vec3 middle = 0.5f * (bow.from + bow.to), half = 0.5f * (bow.to - bow.from);
    const glm::vec3 up(0, 1, 0), along = glm::normalize(half), across = glm::cross(along, up);
    const float length = glm::length(half);
    std::vector<BowFrame> points;
    for (int i = 0; i <= segments; ++i) {
        const float angle =
            glm::radians(bow.begin + (bow.end - bow.begin) * static_cast<float>(i) / segments);
        const float c = std::cos(angle), s = std::sin(angle);
        const glm::vec3 out = -c / length * along + s / bow.rise * up;
        points.push_back({middle - c * half + s * bow.rise * up, -glm::normalize(out), across});
    }
    return points;
}

void add_rib(MeshBuilder& b, const Bow& bow, float width, int segments) {
    const float w = 0.5f * width;
    const Profile profile{{-0.5f * w, -w},        {0.5f * w, -w},        {0.9f * w, -0.5f * w},
                          {1.7f * w, -0.35f * w}, {1.7f * w, 0.35f * w}, {0.9f * w, 0.5f * w},
                          {0.5f * w, w},          {-0.5f * w, w}};
    std::vector<Frame> frames;
    for (const auto& p : bow_points(bow, segments)) frames.push_back({p.point, p.inwards, p.across});
    moulding(b, profile, frames);
}

void add_vaults(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder webs, ribs;
    const Row over_nave{-nave, nave, vault_spring, vault_rise, vault_top};
    add_webs(webs, over_nave, detail.segments(8, 2));
    add_ribs(ribs, over_nave, 0.2f, detail);
    for (const float side : {-1.0f, 1.0f}) {
        const Row over_aisle{std::min(side * arcade_back, side * aisle),
                             std::max(side * arcade_back, side * aisle), arcade_spring, aisle_rise,
                             aisle_top};
        add_webs(webs, over_aisle, detail.segments(7, 2));
        add_ribs(ribs, over_aisle, 0.15f, detail);
    }
    add_mesh(scene, webs.take("vaults", materials.vault));
    add_mesh(scene, ribs.take("ribs", materials.pale));
}

}  // namespace ir::scene::builtin::cathedral_parts
