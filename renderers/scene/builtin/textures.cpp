#include "renderers/scene/builtin/textures.h"

#include <algorithm>
#include <cmath>

#include "renderers/scene/builtin/mesh_builder.h"
#include "renderers/scene/builtin/painting.h"

namespace ir::scene::builtin {
namespace {

using namespace painting;

struct Brick {
    int column, row;
    float to_joint;  ///< distance to the nearest edge, in units of the texture's side
};

Brick brick_at(float u, float v) {
    constexpr int columns = 5, rows = 16;
    const float y = fraction(v) * rows;
    const int row = std::min(static_cast<int>(y), rows - 1);
    const float x = fraction(u + (row % 2) * 0.5f / columns) * columns;
    const float dx = std::min(fraction(x), 1 - fraction(x)) / columns;
    const float dy = std::min(fraction(y), 1 - fraction(y)) / rows;
    return {static_cast<int>(x) % columns, row, std::min(dx, dy)};
}

float brick_height(float u, float v) {
    return 0.008f * smooth(0.002f, 0.008f, brick_at(u, v).to_joint) + 0.0015f * noise(u, v, 48, 3);
}

struct Tile {
    bool is_dark, is_inset;
    float to_joint;
};

Tile tile_at(float u, float v) {
    const float x = fraction(u) * 2, y = fraction(v) * 2;
    const float dx = std::min(fraction(x), 1 - fraction(x)), dy = std::min(fraction(y), 1 - fraction(y));
    const float inset = dx + dy - 0.2f;  // a lozenge at every corner
    const bool is_dark = (static_cast<int>(x) + static_cast<int>(y)) % 2;
    if (inset < 0) return {is_dark, true, -0.35f * inset};
    return {is_dark, false, 0.5f * std::min({dx, dy, 0.7f * inset})};
}

float tile_height(float u, float v) {
    return 0.004f * smooth(0.001f, 0.007f, tile_at(u, v).to_joint);
}

}  // namespace

TexturePair bricks() {
    const auto colour = [](float u, float v) {
        const Brick brick = brick_at(u, v);
        const float tone = 0.75f + 0.5f * cell_random(brick.column, brick.row, 11);
        const float grain = 0.85f + 0.3f * noise(u, v, 40, 5);
        const glm::vec3 clay = glm::vec3(0.42f, 0.2f, 0.12f) * tone * grain;
        const glm::vec3 mortar = glm::vec3(0.5f, 0.45f, 0.38f) * grain;
        return glm::vec4(glm::mix(mortar, clay, smooth(0.003f, 0.006f, brick.to_joint)), 1);
    };
    return {painted("bricks", 256, colour), normals_of("bricks normal", 256, brick_height)};
}

TexturePair tiles() {
    const auto colour = [](float u, float v) {
        const Tile tile = tile_at(u, v);
        const glm::vec3 stone = tile.is_inset  ? glm::vec3(0.3f, 0.11f, 0.08f)
                                : tile.is_dark ? glm::vec3(0.36f, 0.3f, 0.24f)
                                               : glm::vec3(0.62f, 0.55f, 0.45f);
        const float grain = 0.82f + 0.2f * noise(u, v, 12, 7) + 0.16f * noise(u, v, 61, 9);
        return glm::vec4(glm::mix(glm::vec3(0.2f), stone * grain, smooth(0.001f, 0.005f, tile.to_joint)), 1);
    };
    return {painted("tiles", 256, colour), normals_of("tiles normal", 256, tile_height)};
}

Texture stripes(const std::string& name, glm::vec3 ground, glm::vec3 stripe) {
    return painted(name, 128, [=](float u, float v) {
        const bool is_border = v < 0.08f || v > 0.9f;
        const float lozenge = std::abs(fraction(8 * u) - 0.5f) + std::abs(fraction(12 * v) - 0.5f);
        const bool is_line = (v > 0.1f && v < 0.12f) || (v > 0.86f && v < 0.88f);
        const bool is_figure = !is_border && (is_line || lozenge < 0.16f);
        const float weave = 0.92f + 0.08f * std::sin(128 * pi * u) * std::sin(128 * pi * v);
        return glm::vec4((is_border || is_figure ? stripe : ground) * weave, 1);
    });
}

Texture leaf() {
    Texture texture = painted("leaf", 64, [](float u, float v) {
        const float half_width = 0.42f * std::sin(pi * std::pow(v, 0.75f));
        const float x = std::abs(u - 0.5f);
        const float vein = x < 0.02f || fraction(7 * (v + x)) < 0.12f ? 0.75f : 1.0f;
        const glm::vec3 green = glm::vec3(0.13f, 0.3f, 0.06f) * vein * (0.8f + 0.4f * noise(u, v, 6, 1));
        return glm::vec4(green, x < half_width ? 1.0f : 0.0f);
    });
    texture.sampler.wrap_s = texture.sampler.wrap_t = Wrap::clamp_to_edge;
    return texture;
}

Texture grille() {
    return painted("grille", 128, [](float u, float v) {
        const float x = fraction(4 * u) - 0.5f, y = fraction(4 * v) - 0.5f;
        const float circle = std::abs(std::hypot(x, y) - 0.32f);
        const bool is_bar = std::min(std::abs(x), 0.5f - std::abs(x)) < 0.05f || 0.5f - std::abs(y) < 0.05f;
        const bool is_iron = is_bar || circle < 0.055f;
        return glm::vec4(glm::vec3(0.06f, 0.055f, 0.05f), is_iron ? 1.0f : 0.0f);
    });
}

int add_texture(Scene& scene, Texture texture) {
    scene.textures.push_back(std::move(texture));
    return static_cast<int>(scene.textures.size()) - 1;
}

int add_textured(Scene& scene, const std::string& name, TexturePair pair, float period, float roughness) {
    const int index = add_material(scene, name, glm::vec3(1), roughness);
    Material& material = scene.materials[index];
    for (auto* slot : {&material.base_colour_texture, &material.normal_texture})
        slot->scale = glm::vec2(1 / period);
    if (!pair.colour.rgba.empty())
        material.base_colour_texture.texture = add_texture(scene, std::move(pair.colour));
    if (!pair.normal.rgba.empty())
        material.normal_texture.texture = add_texture(scene, std::move(pair.normal));
    return index;
}

void add_tangents(Scene& scene) {
    for (auto& mesh : scene.meshes)
        if (scene.materials[mesh.material].normal_texture.texture >= 0) generate_tangents(mesh);
}

}  // namespace ir::scene::builtin
