// Uneven ground with a mound for each grave, field stones, and a path of flat stones.

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/graveyard.h"
#include "renderers/scene/builtin/painting.h"
#include "renderers/scene/builtin/plates.h"
#include "renderers/scene/builtin/random.h"

namespace ir::scene::builtin::graveyard_parts {
namespace {

constexpr glm::vec2 ground_low{-12, -16}, ground_high{12, 10};
constexpr float ground_bottom = -0.8f;

/// Lines of the grid lie closer in the middle, where the graves are.
float spread(float t) {
    const float s = 2 * t - 1;
    return 0.5f + 0.5f * (0.6f * s + 0.4f * s * s * s);
}

glm::vec3 ground_point(float u, float v) {
    const glm::vec2 place = glm::mix(ground_low, ground_high, glm::vec2(spread(u), spread(1 - v)));
    return {place.x, ground_height(place), place.y};
}

/// A closed body: the ground, its sides and its bottom.
void add_soil(MeshBuilder& b, int columns, int rows) {
    b.surface(columns, rows, ground_point, {24, 26});
    struct Edge {
        glm::vec2 from, to;  ///< parameters, outside to the right of the way
        glm::vec3 normal;
        int count;
    };
    const Edge edges[4] = {{{0, 0}, {1, 0}, {0, 0, 1}, columns},
                           {{1, 0}, {1, 1}, {1, 0, 0}, rows},
                           {{1, 1}, {0, 1}, {0, 0, -1}, columns},
                           {{0, 1}, {0, 0}, {-1, 0, 0}, rows}};
    for (const auto& e : edges) {
        // The parameters of the grid to the last bit, also backwards.
        const auto at = [&](float t) {
            const int step = static_cast<int>(std::lround(t * e.count));
            const auto parameter = [&](float from, float to) {
                return from == to ? from : static_cast<float>(to > from ? step : e.count - step) / e.count;
            };
            return ground_point(parameter(e.from.x, e.to.x), parameter(e.from.y, e.to.y));
        };
        b.grid(e.count, 1, [&](float t, float high) {
            glm::vec3 p = at(t);
            const glm::vec2 uv(t * 24, high);
            if (high < 0.5f) p.y = ground_bottom;
            return Vertex{p, e.normal, uv};
        });
        b.grid(e.count, 1, [&](float t, float outer) {
            glm::vec3 p = at(t);
            if (outer < 0.5f) p.x = p.z = 0;
            p.y = ground_bottom;
            return Vertex{p, {0, -1, 0}, {p.x, p.z}};
        });
    }
}

/// A lump: a ball with dents, flattened and turned.
void add_rock(MeshBuilder& b, glm::vec3 centre, float radius, int segments, Random& random) {
    const glm::vec3 axes(random.between(0.8f, 1.25f), random.between(0.5f, 0.75f),
                         random.between(0.8f, 1.2f));
    glm::vec3 dents[5];
    for (auto& dent : dents)
        dent =
            glm::normalize(glm::vec3(random.between(-1, 1), random.between(-0.4f, 1), random.between(-1, 1)));
    const float turn = random.between(0, 2 * pi);
    b.transform = glm::rotate(glm::translate(glm::mat4(1), centre), turn, {0, 1, 0});
    const int rows = std::max(3, segments / 2);
    b.grid(segments, rows, [&](float u, float v) {
        const int column = static_cast<int>(std::lround(u * segments)) % segments;
        const float angle = -2 * pi * static_cast<float>(column) / segments, rise = pi * (v - 0.5f);
        const float reach = v == 0 || v == 1 ? 0 : std::cos(rise);
        const glm::vec3 out(reach * std::cos(angle), std::sin(rise), reach * std::sin(angle));
        float scale = 1;
        glm::vec3 normal = out;
        for (const auto& dent : dents) {  // cut off by planes, softly
            const float over = glm::dot(out, dent) - 0.72f;
            if (over <= 0) continue;
            scale -= 0.9f * over;
            normal += 1.2f * over * dent;
        }
        return Vertex{radius * scale * out * axes, glm::normalize(normal / axes),
                      radius * glm::vec2(6.28f * u, 3.14f * v)};
    });
    b.transform = glm::mat4(1);
}

void add_rocks(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder b;
    const int segments = detail.segments(8, 5), count = detail.segments(90, 20);
    for (int i = 0; i < count; ++i) {
        Random random(9000 + static_cast<std::uint32_t>(i));
        const glm::vec2 place(random.between(-5, 8), random.between(-4.4f, 4.6f));
        const float size = random.unit(), radius = 0.035f + 0.13f * size * size * size;
        add_rock(b, {place.x, ground_height(place) + 0.15f * radius, place.y}, radius, segments, random);
    }
    add_mesh(scene, b.take("field stones", materials.stone[0]));
}

/// Irregular flat stones from the gate towards the viewer.
void add_path(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder b;
    Random random(4711);
    for (int i = 0; i < 19; ++i)
        for (const float side : {-0.27f, 0.27f}) {
            const float z = -4.2f + 0.58f * static_cast<float>(i) + random.between(-0.08f, 0.08f);
            const glm::vec2 place(path_middle(z) + side + random.between(-0.05f, 0.05f), z);
            Outline outline;
            const int corners = 6 + static_cast<int>(random.bits() % 3);
            for (int k = 0; k < corners; ++k) {
                const float angle =
                    2 * pi * (static_cast<float>(k) + random.between(-0.25f, 0.25f)) / corners;
                const float radius = random.between(0.21f, 0.27f);
                outline.push_back(radius * glm::vec2(std::cos(angle), 1.05f * std::sin(angle)));
            }
            glm::mat4 m = glm::translate(glm::mat4(1), {place.x, ground_height(place), place.y});
            m = glm::rotate(m, glm::radians(random.between(-4, 4)), {1, 0, 0});
            b.transform = glm::rotate(m, glm::radians(random.between(-4, 4)), {0, 0, 1});
            lying_plate(b, {outline, -0.09f, 0.035f, detail.bevel(0.014f), {0, 0}, place});
        }
    add_mesh(scene, b.take("path", materials.stone[1]));
}

}  // namespace

float path_middle(float z) {
    return 1.2f - 0.1f * std::sin(0.7f * z) - 0.035f * (z + 4.6f);
}

float ground_height(glm::vec2 place) {
    using painting::noise;
    using painting::smooth;
    const glm::vec2 q = place / 30.0f;
    float height = 0.34f * (noise(q.x, q.y, 7, 3) - 0.5f) + 0.09f * (noise(q.x, q.y, 29, 4) - 0.5f);
    const float path = smooth(0.9f, 0.5f, std::abs(place.x - path_middle(place.y)));
    height -= 0.06f * path;
    for (const auto& plot : plots()) {
        const glm::vec2 away =
            (place - plot.place - glm::vec2(0, 0.85f * plot.size)) / glm::vec2(0.42f, 0.75f);
        const float squared = glm::dot(away, away);
        if (squared < 6 && plot.kind != Kind::table_tomb) height += 0.11f * std::exp(-squared * squared);
    }
    return height + 2.1f * smooth(-6.5f, -15, place.y);  // a hill behind the gate
}

void add_ground(Scene& scene, const Materials& materials, const Detail& detail) {
    MeshBuilder b;
    add_soil(b, detail.segments(66, 16), detail.segments(66, 16));
    add_mesh(scene, b.take("ground", materials.soil));
    add_rocks(scene, materials, detail);
    add_path(scene, materials, detail);
}

}  // namespace ir::scene::builtin::graveyard_parts
