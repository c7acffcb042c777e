#include "renderers/passes/scene/texel_buffer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>

#include "renderers/graph/pass_context.h"
#include "renderers/image/colour_map.h"
#include "shaders/passes/scene/texels.glsl.h"

namespace ir::passes {
namespace {

constexpr std::size_t levels = 256, words_per_entry = 4;

std::vector<bool> textures_of_surfaces(const scene::Scene& scene) {
    std::vector<bool> needed(scene.textures.size());
    for (const auto& material : scene.materials)
        for (const auto* slot :
             {&material.base_colour_texture, &material.metallic_roughness_texture, &material.normal_texture,
              &material.emission_texture, &material.transmission_texture})
            if (slot->texture >= 0) needed.at(static_cast<std::size_t>(slot->texture)) = true;
    return needed;
}

int halvings_to(int side, int most) {
    int halvings = 0;
    while (((side - 1) >> halvings) + 1 > most) ++halvings;
    return halvings;
}

TexelLayout layout_with(const scene::Scene& scene, int side) {
    TexelLayout layout;
    layout.side = side;
    layout.textures.resize(scene.textures.size());
    layout.words = levels + words_per_entry * scene.textures.size();
    const auto needed = textures_of_surfaces(scene);
    for (std::size_t i = 0; i < needed.size(); ++i) {
        if (!needed[i]) continue;
        const auto& texture = scene.textures[i];
        auto& entry = layout.textures[i];
        entry.halvings = halvings_to(std::max(texture.width, texture.height), side);
        entry.first_word = static_cast<std::uint32_t>(layout.words);
        entry.width = ((texture.width - 1) >> entry.halvings) + 1;
        entry.height = ((texture.height - 1) >> entry.halvings) + 1;
        layout.words += static_cast<std::uint64_t>(entry.width) * static_cast<std::uint64_t>(entry.height);
        layout.reduced += entry.halvings > 0;
    }
    return layout;
}

std::array<float, levels> decoded_levels(bool srgb) {
    std::array<float, levels> result{};
    for (std::size_t i = 0; i < levels; ++i) {
        const float encoded = static_cast<float>(i) / 255.0f;
        result[i] = srgb ? linear_from_srgb(encoded) : encoded;
    }
    return result;
}

/// Averages of equal blocks of a texture's texels; those of the last row and column may be smaller.
class BoxFilter {
  public:
    BoxFilter(const scene::Texture& texture, const std::array<float, levels>& decoded, int side)
        : texture_(texture), decoded_(decoded), side_(side) {}

    std::uint32_t texel(int column, int row) const {
        const int right = std::min(texture_.width, (column + 1) * side_);
        const int bottom = std::min(texture_.height, (row + 1) * side_);
        glm::vec4 sum(0);
        for (int y = row * side_; y < bottom; ++y)
            for (int x = column * side_; x < right; ++x) sum += value(x, y);
        return packed(sum / static_cast<float>((right - column * side_) * (bottom - row * side_)));
    }

  private:
    glm::vec4 value(int x, int y) const {
        const auto* bytes = &texture_.rgba[4 * (static_cast<std::size_t>(y) * texture_.width + x)];
        return {decoded_[bytes[0]], decoded_[bytes[1]], decoded_[bytes[2]], bytes[3] / 255.0f};
    }
    static std::uint32_t byte(float value) {
        return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
    }
    std::uint32_t packed(glm::vec4 colour) const {
        std::uint32_t word = byte(colour.a) << 24;
        for (int i = 0; i < 3; ++i)
            word |= byte(texture_.srgb ? srgb_from_linear(colour[i]) : colour[i]) << 8 * i;
        return word;
    }

    const scene::Texture& texture_;
    const std::array<float, levels>& decoded_;
    int side_;
};

static_assert(static_cast<std::uint32_t>(scene::Wrap::repeat) == texels_repeated &&
              static_cast<std::uint32_t>(scene::Wrap::mirrored_repeat) == texels_mirrored &&
              static_cast<std::uint32_t>(scene::Wrap::clamp_to_edge) == texels_clamped);

std::uint32_t flags_of(const scene::Texture& texture) {
    const auto& sampler = texture.sampler;
    return static_cast<std::uint32_t>(sampler.wrap_s) | static_cast<std::uint32_t>(sampler.wrap_t) << 2 |
           (sampler.mag == scene::Filter::linear ? texels_linear : 0u) | (texture.srgb ? texels_srgb : 0u);
}

}  // namespace

TexelLayout texel_layout(const scene::Scene& scene, std::uint64_t max_bytes, int max_side) {
    auto layout = layout_with(scene, max_side);
    while (4 * layout.words > max_bytes && layout.side > 1) layout = layout_with(scene, layout.side / 2);
    return layout;
}

std::vector<std::uint32_t> texel_words(const scene::Scene& scene, const TexelLayout& layout) {
    const auto srgb = decoded_levels(true), linear = decoded_levels(false);
    std::vector<std::uint32_t> words(layout.words);
    for (std::size_t i = 0; i < levels; ++i) words[i] = std::bit_cast<std::uint32_t>(srgb[i]);
    for (std::size_t i = 0; i < layout.textures.size(); ++i) {
        const auto& entry = layout.textures[i];
        if (entry.width == 0) continue;
        const auto& texture = scene.textures[i];
        auto* head = &words[levels + words_per_entry * i];
        head[0] = entry.first_word;
        head[1] = static_cast<std::uint32_t>(entry.width) | static_cast<std::uint32_t>(entry.height) << 16;
        head[2] = flags_of(texture);
        const BoxFilter filter(texture, texture.srgb ? srgb : linear, 1 << entry.halvings);
        auto* texel = &words[entry.first_word];
        for (int y = 0; y < entry.height; ++y)
            for (int x = 0; x < entry.width; ++x) *texel++ = filter.texel(x, y);
    }
    return words;
}

graph::BufferRef texel_buffer(graph::GraphBuilder& builder) {
    const auto& scene = *builder.inputs().scene;
    const auto layout = texel_layout(scene, std::min(max_texel_bytes, builder.max_buffer_bytes()));
    if (layout.reduced > 0)
        builder.note(std::to_string(layout.reduced) + " textures are reduced to at most " +
                     std::to_string(layout.side) +
                     " texels a side where rays hit them and where their emission is sampled");
    graph::BufferDesc desc;
    desc.text = {.key = "scene.texels",
                 .label = "Textures in one array",
                 .doc =
                     "What rays that hit anything look up: base colours, metallic and roughness, normals, "
                     "emission, transmission."};
    desc.name = "Texels";
    desc.fields = {{"word", graph::FieldType::u32}};
    desc.elements = layout.words;
    // the textures of an animated scene stay while its world changes
    if (!scene.content_hash.empty())
        desc.fingerprint = scene.content_hash + " texels " + std::to_string(layout.side);
    const auto texels = builder.buffer(std::move(desc));
    builder.pass("upload texels").writes(texels).execute([=](graph::PassContext& context) {
        const auto words = texel_words(*context.inputs().scene, layout);
        context.upload(texels, std::as_bytes(std::span(words)));
    });
    return texels;
}

}  // namespace ir::passes
