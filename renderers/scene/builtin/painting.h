#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "renderers/core/constants.h"
#include "renderers/core/parallel_for.h"
#include "renderers/image/colour_map.h"
#include "renderers/scene/builtin/random.h"
#include "renderers/scene/scene.h"

/// What procedural textures are painted with.
namespace ir::scene::builtin::painting {

inline std::uint8_t byte(float value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255 + 0.5f);
}

inline Texture blank(const std::string& name, int size, bool srgb) {
    Texture texture;
    texture.name = name;
    texture.width = texture.height = size;
    texture.srgb = srgb;
    texture.rgba.resize(static_cast<std::size_t>(size) * size * 4);
    return texture;
}

/// Calls `paint` with column, row and texel of each, in many threads.
template <class Paint>
void fill(Texture& texture, const Paint& paint) {
    parallel_for(0, 0, texture.height, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < texture.width; ++x)
            paint(x, y, &texture.rgba[4 * (static_cast<std::size_t>(y) * texture.width + x)]);
    });
}

/// `colour` gives linear RGB and alpha at texture coordinates in [0,1).
template <class Colour>
Texture painted(const std::string& name, int size, Colour colour) {
    Texture texture = blank(name, size, true);
    fill(texture, [&](int x, int y, std::uint8_t* texel) {
        const glm::vec4 c = colour((x + 0.5f) / size, (y + 0.5f) / size);
        for (int k = 0; k < 3; ++k) texel[k] = byte(srgb_from_linear(c[k]));
        texel[3] = byte(c.a);
    });
    return texture;
}

/// Normals of a height field that repeats; +Y of the normal points against v, as in glTF. Heights are in
/// units of the texture's side.
template <class Height>
Texture normals_of(const std::string& name, int size, Height height) {
    Texture texture = blank(name, size, false);
    const float step = 1.0f / size;
    fill(texture, [&](int x, int y, std::uint8_t* texel) {
        const float u = (x + 0.5f) * step, v = (y + 0.5f) * step;
        const float du = (height(u + step, v) - height(u - step, v)) / (2 * step);
        const float dv = (height(u, v + step) - height(u, v - step)) / (2 * step);
        const glm::vec3 n = glm::normalize(glm::vec3(-du, dv, 1));
        for (int k = 0; k < 3; ++k) texel[k] = byte(0.5f * n[k] + 0.5f);
        texel[3] = 255;
    });
    return texture;
}

inline float fraction(float x) {
    return x - std::floor(x);
}

/// The same for the same cell, in [0,1).
inline float cell_random(int x, int y, std::uint32_t seed) {
    return Random(static_cast<std::uint32_t>(x) * 7919u + static_cast<std::uint32_t>(y) * 104729u + seed)
        .unit();
}

/// 0 at edge0, 1 at edge1, level at both; the edges may fall.
inline float smooth(float edge0, float edge1, float x) {
    const float t = std::clamp((x - edge0) / (edge1 - edge0), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

/// Smooth noise of period 1 with `cells` cells.
inline float noise(float u, float v, int cells, std::uint32_t seed) {
    const float x = fraction(u) * cells, y = fraction(v) * cells;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const float a = smooth(0, 1, x - i), b = smooth(0, 1, y - j);
    const auto at = [&](int p, int q) { return cell_random((i + p) % cells, (j + q) % cells, seed); };
    return std::lerp(std::lerp(at(0, 0), at(1, 0), a), std::lerp(at(0, 1), at(1, 1), a), b);
}

}  // namespace ir::scene::builtin::painting
