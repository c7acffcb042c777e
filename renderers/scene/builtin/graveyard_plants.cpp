// Grass blade by blade, a bare tree, ivy on the wall and flowers on the graves.

#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/graveyard.h"
#include "renderers/scene/builtin/painting.h"
#include "renderers/scene/builtin/plates.h"
#include "renderers/scene/builtin/random.h"

namespace ir::scene::builtin::graveyard_parts {
namespace {

// --- The tree -------------------------------------------------------------------------------------------

struct Tree {
    MeshBuilder& builder;
    Detail detail;
    int levels;
};

void grow(const Tree& tree, Random random, glm::vec3 from, glm::vec3 way, float length, float radius,
          int level) {
    constexpr int longest = 10;
    const int pieces = std::min(longest, tree.detail.segments(level == 0 ? 9 : level < 3 ? 5 : 2, 2));
    std::vector<glm::vec3> points{from};
    std::vector<float> radii{level == 0 ? 1.5f * radius : radius};
    const bool is_twig = level == tree.levels;
    for (int i = 1; i <= pieces; ++i) {
        way = glm::normalize(way + (level ? 0.26f : 0.16f) * random.direction() + glm::vec3(0, 0.05f, 0));
        points.push_back(points.back() + way * (length / static_cast<float>(pieces)));
        const float t = static_cast<float>(i) / static_cast<float>(pieces);
        radii.push_back(radius * (is_twig ? 1 - 0.8f * t : 1 - 0.42f * t));
    }
    limb(tree.builder, points, radii, std::max(3, tree.detail.segments(9 - 2 * std::min(level, 3), 3)));
    if (is_twig) return;
    constexpr int children_at[] = {5, 4, 4, 3, 2, 2};
    const int children = children_at[level];
    for (int k = 0; k < children; ++k) {
        // The last two go on from the end, the others leave on the way.
        const bool is_fork = k >= children - 2;
        const int at = is_fork ? pieces
                               : std::min(pieces, 1 + static_cast<int>(random.between(0.4f, 1) *
                                                                       static_cast<float>(pieces)));
        const glm::vec3 along = glm::normalize(points[at] - points[at - 1]);
        const glm::vec3 aside = glm::normalize(glm::cross(along, random.direction()));
        const float angle = glm::radians(is_fork ? random.between(18, 38) : random.between(38, 68));
        const float scale = is_fork ? random.between(0.68f, 0.82f) : random.between(0.5f, 0.7f);
        const glm::vec3 start = points[at] - 0.3f * radii[at] * along;
        const Random own(random.bits());
        grow(tree, own, start, std::cos(angle) * along + std::sin(angle) * aside, scale * length,
             radii[at] * (is_fork ? 0.8f : 0.6f), level + 1);
    }
}

/// Roots that spread over the ground.
void add_roots(const Tree& tree, glm::vec3 foot, float radius) {
    for (int i = 0; i < 6; ++i) {
        Random random(77 + static_cast<std::uint32_t>(i));
        const float angle = 2 * pi * (static_cast<float>(i) + random.between(-0.3f, 0.3f)) / 6;
        const glm::vec3 out(std::cos(angle), 0, std::sin(angle));
        std::vector<glm::vec3> points;
        std::vector<float> radii;
        for (const float t : {0.0f, 0.3f, 0.6f, 1.0f}) {
            glm::vec3 p = foot + out * (radius * (0.35f + 3.2f * t));
            p.y = ground_height({p.x, p.z}) + 0.34f * (1 - t) * (1 - t) - 0.07f * t;
            points.push_back(p);
            radii.push_back(radius * (0.55f - 0.42f * t));
        }
        limb(tree.builder, points, radii, tree.detail.segments(6, 4));
    }
}

// --- Grass ----------------------------------------------------------------------------------------------

struct Blade {
    glm::vec3 foot;
    float turn, height, width, lean;
    float tone;  ///< texture coordinate
};

/// Three triangles: a strip that bends over and ends in a tip.
void add_blade(MeshBuilder& b, const Blade& blade) {
    const glm::vec3 side(std::cos(blade.turn), 0, std::sin(blade.turn));
    const glm::vec3 over(-side.z, 0, side.x);
    const auto spine = [&](float v) {
        return blade.foot +
               blade.height * (v * glm::vec3(0, 1 - 0.3f * blade.lean * v, 0) + blade.lean * v * v * over);
    };
    b.grid(1, 2, [&](float u, float v) {
        const float half = 0.5f * blade.width * (v == 0 ? 1 : v < 1 ? 0.8f : 0);
        const glm::vec3 along = glm::vec3(0, 1 - 0.6f * blade.lean * v, 0) + 2 * blade.lean * v * over;
        return Vertex{
            spine(v) + (2 * u - 1) * half * side, glm::normalize(glm::cross(side, along)), {blade.tone, v}};
    });
}

bool is_on_grass(glm::vec2 p) {
    const glm::vec2 inside = p - wall_corner;
    if (inside.x < 0.02f || inside.y < 0.02f) return false;
    return std::abs(p.x - path_middle(p.y)) > 0.52f;
}

/// Around the feet of stones, along the walls, or anywhere in patches.
glm::vec2 tuft_place(Random& random) {
    const float kind = random.unit();
    if (kind < 0.34f) {
        const auto all = plots();
        const Plot& plot = all[random.bits() % all.size()];
        const bool is_table = plot.kind == Kind::table_tomb;
        const float angle = random.between(0, 2 * pi), away = random.between(1, 1.5f);
        const glm::vec2 half = is_table ? glm::vec2(0.52f, 0.96f) : glm::vec2(0.42f, 0.24f);
        return plot.place + plot.size * away * half * glm::vec2(std::cos(angle), std::sin(angle));
    }
    if (kind < 0.44f) return {random.between(wall_corner.x, 8), wall_corner.y + random.between(0.02f, 0.3f)};
    if (kind < 0.5f) return {wall_corner.x + random.between(0.02f, 0.3f), random.between(wall_corner.y, 4)};
    return {random.between(-5.2f, 5.5f), random.between(-4.6f, 4.6f)};
}

bool is_in_patch(glm::vec2 p, Random& random) {
    const float density = painting::noise(p.x / 12, p.y / 12, 14, 17);
    return random.unit() < painting::smooth(0.3f, 0.7f, density);
}

void add_tuft(MeshBuilder& b, glm::vec2 place, int blades, Random& random) {
    const float size = random.between(0.55f, 1.25f), spread = 0.075f * size;
    for (int i = 0; i < blades; ++i) {
        const float angle = random.between(0, 2 * pi), away = spread * std::sqrt(random.unit());
        const glm::vec2 foot = place + away * glm::vec2(std::cos(angle), std::sin(angle));
        Blade blade;
        blade.foot = {foot.x, ground_height(foot) - 0.012f, foot.y};
        // Leaning outwards: `over` is a right angle on from the turn.
        blade.turn = angle - pi / 2 + random.between(-0.7f, 0.7f);
        blade.height = size * random.between(0.08f, 0.24f);
        blade.width = random.between(0.009f, 0.017f);
        blade.lean = random.between(0.15f, 0.95f);
        blade.tone = random.unit();
        add_blade(b, blade);
    }
}

// --- Leaves and petals ----------------------------------------------------------------------------------

/// A lozenge of two triangles that fold along the middle.
void add_leaf(MeshBuilder& b, glm::vec3 stem, glm::vec3 tip, glm::vec3 normal, float width, float tone) {
    const glm::vec3 side = 0.5f * width * glm::normalize(glm::cross(tip - stem, normal));
    const glm::vec3 middle = glm::mix(stem, tip, 0.4f) - 0.12f * width * normal;
    for (const float s : {-1.0f, 1.0f}) {
        const glm::vec3 wing = middle + s * side + 0.3f * width * normal;
        const glm::vec3 face = glm::normalize(s * glm::cross(wing - stem, tip - stem));
        b.grid(1, 1, [&](float u, float v) {
            const bool is_wing = (s > 0) == (u > 0.5f);
            const glm::vec3 p = v > 0.5f ? tip : is_wing ? wing : stem;
            return Vertex{p, face, {tone, v > 0.5f ? 1.0f : 0.3f}};
        });
    }
}

void add_flower(MeshBuilder& b, glm::vec3 at, Random& random) {
    const glm::vec3 up =
        glm::normalize(glm::vec3(random.between(-0.5f, 0.5f), 1, random.between(-0.2f, 0.8f)));
    const glm::vec3 x = glm::normalize(glm::cross(up, glm::vec3(1, 0.2f, 0))), y = glm::cross(up, x);
    const float tone = random.unit();
    for (int i = 0; i < 6; ++i) {
        const float angle = 2 * pi * static_cast<float>(i) / 6;
        const glm::vec3 out = std::cos(angle) * x + std::sin(angle) * y;
        add_leaf(b, at, at + 0.045f * out + 0.018f * up, up, 0.036f, tone);
    }
}

}  // namespace

void add_tree(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder b;
    const Tree tree{b, detail, detail.scale < 0.25f ? 3 : detail.scale < 3 ? 5 : 6};
    const glm::vec3 foot(tree_place.x, ground_height(tree_place) - 0.2f, tree_place.y);
    grow(tree, Random(31), foot, glm::normalize(glm::vec3(-0.12f, 1, 0.03f)), 2.1f, 0.19f, 0);
    add_roots(tree, foot + glm::vec3(0, 0.2f, 0), 0.19f);
    add_mesh(scene, b.take("tree", materials.bark));
}

void add_ivy(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder ivy, petals;
    const int leaves = detail.count(1900);
    for (int i = 0; i < leaves; ++i) {
        Random random(20000 + static_cast<std::uint32_t>(i));
        // Hangs over the coping and thins out downwards.
        const float along = random.unit(), drop = random.unit() * random.unit();
        const float reach = 0.25f + 1.3f * painting::noise(along, 0.5f, 9, 61);
        const float y = wall_height + 0.08f - reach * drop;
        const float x = -4.3f + 3.2f * along;
        const glm::vec3 stem(
            x, y, wall_corner.y + 0.03f + random.between(0, 0.05f) + (y > wall_height - 0.02f ? 0.05f : 0));
        const glm::vec3 tip = stem + glm::vec3(random.between(-0.05f, 0.05f), -random.between(0.035f, 0.07f),
                                               random.between(0.015f, 0.04f));
        add_leaf(ivy, stem, tip, glm::normalize(glm::vec3(random.between(-0.4f, 0.4f), 0.45f, 1)),
                 random.between(0.045f, 0.08f), random.unit());
    }
    const auto all = plots();
    for (const int grave : {0, 4, 8, 11}) {
        Random random(700 + static_cast<std::uint32_t>(grave));
        for (int i = 0; i < detail.segments(9, 3); ++i) {
            const glm::vec2 place =
                all[grave].place + glm::vec2(random.between(-0.24f, 0.24f), random.between(0.26f, 0.5f));
            add_flower(petals, {place.x, ground_height(place) + random.between(0.1f, 0.19f), place.y},
                       random);
        }
    }
    add_mesh(scene, ivy.take("ivy", materials.ivy));
    add_mesh(scene, petals.take("flowers", materials.flower));
}

void add_grass(Scene& scene, const Materials& materials, std::size_t triangles) {
    constexpr int blades_of_tuft = 12, triangles_of_blade = 3;
    const std::size_t others = scene.primitive_triangles();
    const std::size_t count = triangles > others ? (triangles - others) / triangles_of_blade : 0;
    MeshBuilder green, dry;
    std::size_t left = count;
    for (std::uint32_t i = 0; left > 0; ++i) {
        Random random(100000 + i);
        const glm::vec2 place = tuft_place(random);
        if (!is_on_grass(place) || !is_in_patch(place, random)) continue;
        const int blades = static_cast<int>(std::min<std::size_t>(left, blades_of_tuft));
        add_tuft(random.unit() < 0.2f ? dry : green, place, blades, random);
        left -= static_cast<std::size_t>(blades);
    }
    add_mesh(scene, green.take("grass", materials.grass));
    add_mesh(scene, dry.take("dry grass", materials.dry_grass));
}

}  // namespace ir::scene::builtin::graveyard_parts
