#include "renderers/scene/opacity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/core/error.h"

namespace ir::scene {
namespace {

constexpr std::uint32_t word_bits = 32;

std::uint32_t words_per_row(int width) {
    return (static_cast<std::uint32_t>(width) + word_bits - 1) / word_bits;
}

OpacityBitmap bitmap_of(const Scene& scene, int index, std::vector<std::uint32_t>& words) {
    const auto& material = scene.materials[index];
    const int slot = material.base_colour_texture.texture;
    const Texture* texture = slot >= 0 ? &scene.textures[slot] : nullptr;
    OpacityBitmap bitmap;
    bitmap.material = index;
    bitmap.width = texture ? texture->width : 1;
    bitmap.height = texture ? texture->height : 1;
    if (words.size() > std::numeric_limits<std::uint32_t>::max() / 2)
        throw InputError(scene.name, "materials",
                         "too many texels with alpha masks; scale the textures down");
    bitmap.first_word = static_cast<std::uint32_t>(words.size());
    const auto row_words = words_per_row(bitmap.width);
    words.resize(words.size() + static_cast<std::size_t>(row_words) * bitmap.height, 0);
    for (int y = 0; y < bitmap.height; ++y)
        for (int x = 0; x < bitmap.width; ++x) {
            const auto texel = (static_cast<std::size_t>(y) * bitmap.width + x) * 4;
            const float alpha = (texture ? texture->rgba[texel + 3] / 255.0f : 1.0f) * material.base_colour.a;
            if (alpha < material.alpha_cutoff) continue;
            const auto word = bitmap.first_word + static_cast<std::size_t>(y) * row_words + x / word_bits;
            words[word] |= 1u << (x % word_bits);
        }
    return bitmap;
}

/// Index of the nearest texel along one axis.
int nearest_texel(float coordinate, int size, Wrap wrap) {
    if (!std::isfinite(coordinate)) return 0;
    if (wrap != Wrap::clamp_to_edge) {
        const float whole = std::floor(coordinate);
        const bool turned = wrap == Wrap::mirrored_repeat && std::fmod(whole, 2.0f) != 0;
        coordinate = turned ? 1 - (coordinate - whole) : coordinate - whole;
    }
    const float texel = std::floor(coordinate * static_cast<float>(size));
    return static_cast<int>(std::clamp(texel, 0.0f, static_cast<float>(size - 1)));
}

}  // namespace

void build_opacity(const Scene& scene, World& world) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].alpha_mode == AlphaMode::mask)
            world.opacity.push_back(bitmap_of(scene, static_cast<int>(i), world.opacity_words));
}

glm::vec2 transformed_uv(const TextureSlot& slot, glm::vec2 uv) {
    // [KHR_texture_transform: translation * rotation * scale, rotation by [c s; -s c]]
    const float c = std::cos(slot.rotation), s = std::sin(slot.rotation);
    const auto scaled = slot.scale * uv;
    return slot.offset + glm::vec2(c * scaled.x + s * scaled.y, -s * scaled.x + c * scaled.y);
}

bool is_covered(const World& world, const OpacityBitmap& bitmap, const Sampler& sampler, glm::vec2 uv) {
    const int x = nearest_texel(uv.x, bitmap.width, sampler.wrap_s);
    const int y = nearest_texel(uv.y, bitmap.height, sampler.wrap_t);
    const auto word =
        bitmap.first_word + static_cast<std::size_t>(y) * words_per_row(bitmap.width) + x / word_bits;
    return (world.opacity_words[word] >> (x % word_bits) & 1u) != 0;
}

}  // namespace ir::scene
