#include "renderers/scene/builtin/interior_textures.h"

#include "renderers/scene/builtin/painting.h"

namespace ir::scene::builtin {
namespace {

using namespace painting;

/// Growth rings cut lengthwise, in [0, 1]; repeats in u and v.
float grain(float u, float v, std::uint32_t seed) {
    const float wander = 0.18f * noise(u, v, 3, seed) + 0.03f * noise(2 * u, v, 16, seed + 1);
    const float rings = 0.5f + 0.5f * std::sin(2 * pi * (7 * v + 6 * wander));
    return 0.65f * rings * rings + 0.35f * noise(3 * u, 9 * v, 9, seed + 2);
}

struct Plank {
    int number;
    float to_joint;  ///< in units of the texture's side
};

Plank plank_at(float u, float v) {
    constexpr int rows = 6;
    const float y = fraction(v) * rows;
    const int row = std::min(static_cast<int>(y), rows - 1);
    const float x = fraction(u + 0.37f * row) * 2;
    const float dx = std::min(fraction(x), 1 - fraction(x)) / 2;
    const float dy = std::min(fraction(y), 1 - fraction(y)) / rows;
    return {row * 2 + static_cast<int>(x), std::min(dx, dy)};
}

float loop_height(float u, float v) {
    const float x = fraction(40 * u + 0.5f * std::floor(40 * v)) - 0.5f, y = fraction(40 * v) - 0.5f;
    const float loop = std::sqrt(std::max(0.0f, 0.3f - x * x - y * y));
    return 0.014f * loop * (0.6f + 0.8f * noise(u, v, 40, 23));
}

}  // namespace

TexturePair carpet() {
    const auto colour = [](float u, float v) {
        const float patch = smooth(0.35f, 0.65f, noise(u, v, 8, 21));
        const float fleck = 0.7f + 0.6f * noise(u, v, 80, 22);
        const glm::vec3 wool = glm::mix(glm::vec3(0.1f, 0.14f, 0.2f), glm::vec3(0.16f, 0.2f, 0.26f), patch);
        return glm::vec4(wool * fleck, 1);
    };
    return {painted("carpet", 256, colour), normals_of("carpet normal", 256, loop_height)};
}

TexturePair planks() {
    const auto colour = [](float u, float v) {
        const Plank plank = plank_at(u, v);
        const float tone = 0.75f + 0.45f * cell_random(plank.number, 1, 31);
        const float g = grain(u + 0.31f * plank.number, v, 33);
        const glm::vec3 oak =
            glm::mix(glm::vec3(0.46f, 0.29f, 0.15f), glm::vec3(0.3f, 0.17f, 0.08f), g) * tone;
        return glm::vec4(oak * (0.35f + 0.65f * smooth(0.0005f, 0.003f, plank.to_joint)), 1);
    };
    const auto height = [](float u, float v) {
        return 0.004f * smooth(0, 0.005f, plank_at(u, v).to_joint) + 0.0006f * grain(u, v, 33);
    };
    return {painted("planks", 256, colour), normals_of("planks normal", 256, height)};
}

Texture wood(const std::string& name, glm::vec3 light, glm::vec3 dark) {
    return painted(name, 256, [=](float u, float v) {
        const float pores = 1 - 0.25f * smooth(0.75f, 0.95f, noise(2 * u, 7 * v, 30, 41));
        return glm::vec4(glm::mix(light, dark, grain(u, v, 43)) * pores, 1);
    });
}

Texture plaster() {
    return normals_of("plaster normal", 256, [](float u, float v) {
        return 0.012f * noise(u, v, 14, 51) + 0.005f * noise(u, v, 37, 52) + 0.0018f * noise(u, v, 90, 53);
    });
}

Texture checks(const std::string& name, glm::vec3 ground, glm::vec3 check) {
    return painted(name, 128, [=](float u, float v) {
        const float across = fraction(4 * u) < 0.5f, along = fraction(4 * v) < 0.5f;
        const float weave = 0.9f + 0.1f * std::sin(128 * pi * u) * std::sin(128 * pi * v);
        return glm::vec4(glm::mix(ground, check, 0.5f * (across + along)) * weave, 1);
    });
}

Texture peel() {
    return normals_of("peel normal", 128, [](float u, float v) {
        return 0.01f * smooth(0.2f, 0.8f, noise(u, v, 24, 61)) + 0.004f * noise(u, v, 11, 62);
    });
}

}  // namespace ir::scene::builtin
