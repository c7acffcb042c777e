#include "renderers/passes/surface/host_texture.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "renderers/image/colour_map.h"

namespace ir::passes {
namespace {

using scene::Wrap;
using Levels = std::array<float, 256>;

Levels make_levels(bool srgb) {
    Levels levels{};
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const float encoded = static_cast<float>(i) / 255.0f;
        levels[i] = srgb ? linear_from_srgb(encoded) : encoded;
    }
    return levels;
}

const float* levels_of(bool srgb) {
    static const Levels linear = make_levels(false), decoded = make_levels(true);
    return srgb ? decoded.data() : linear.data();
}

/// srgb_from_linear from a table: fine enough that bytes differ by one at most, where two are as near.
float encoded_srgb(float linear) {
    constexpr std::size_t size = 1 << 14;
    static const auto table = [] {
        std::array<float, size + 1> values{};
        for (std::size_t i = 0; i <= size; ++i)
            values[i] = srgb_from_linear(static_cast<float>(i) / static_cast<float>(size));
        return values;
    }();
    return table[static_cast<std::size_t>(std::clamp(linear, 0.0f, 1.0f) * size + 0.5f)];
}

/// std::floor without a call; `x` fits an int.
int floor_of(float x) {
    const int truncated = static_cast<int>(x);
    return truncated - (static_cast<float>(truncated) > x);
}

/// From here on floats are whole numbers, which repeat as 0.
constexpr float whole_from = 8388608.0f;

}  // namespace

HostTexture::HostTexture(const scene::Texture& texture, Levels levels)
    : finest_{texture.rgba.data(), texture.width, texture.height},
      values_(levels_of(texture.srgb)),
      wrap_s_(texture.sampler.wrap_s),
      wrap_t_(texture.sampler.wrap_t),
      is_linear_(texture.sampler.mag == scene::Filter::linear),
      is_linear_when_small_(texture.sampler.min == scene::Filter::linear) {
    if (levels == Levels::finest) return;
    own_.push_back(texture.rgba);
    finest_.texels = own_.back().data();
    for (auto level = finest_; texture.sampler.mipmaps && std::max(level.width, level.height) > 1;) {
        const int width = std::max(1, level.width / 2), height = std::max(1, level.height / 2);
        own_.push_back(halved(level, width, height, texture.srgb));
        level = {own_.back().data(), width, height};
        coarser_.push_back(level);
    }
}

/// The next level: the texels around the centre of each of its own, as drivers make mip maps.
HostTexture::Bytes HostTexture::halved(const Level& level, int width, int height, bool srgb) const {
    Bytes texels(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    tbb::parallel_for(0, height, [&](int y) {
        auto* out = texels.data() + 4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
        for (int x = 0; x < width; ++x, out += 4) {
            const auto value = bilinear(level, (glm::vec2(x, y) + 0.5f) / glm::vec2(width, height));
            for (int channel = 0; channel < 3; ++channel) {
                const float encoded = srgb ? encoded_srgb(value[channel]) : value[channel];
                out[channel] = static_cast<std::uint8_t>(255 * encoded + 0.5f);
            }
        }
    });
    return texels;
}

std::uint64_t HostTexture::bytes() const {
    std::uint64_t sum = sizeof *this;
    for (const auto& level : own_) sum += level.size();
    return sum;
}

glm::vec3 HostTexture::at(glm::vec2 uv, glm::vec2 by_column, glm::vec2 by_row) const {
    const glm::vec2 size(finest_.width, finest_.height);
    by_column *= size, by_row *= size;
    const float squared = std::max(glm::dot(by_column, by_column), glm::dot(by_row, by_row));
    if (!(squared > 1)) return at(uv);
    uv = {folded(uv.x, wrap_s_), folded(uv.y, wrap_t_)};
    const auto sample = [&](std::size_t level) {
        const auto& chosen = level == 0 ? finest_ : coarser_[level - 1];
        return is_linear_when_small_ ? bilinear(chosen, uv) : nearest(chosen, uv);
    };
    const float level = std::min(0.5f * std::log2(squared), static_cast<float>(coarser_.size()));
    if (!is_linear_when_small_) return sample(static_cast<std::size_t>(level + 0.5f));
    const auto finer = static_cast<std::size_t>(level);
    if (finer >= coarser_.size()) return sample(coarser_.size());
    return glm::mix(sample(finer), sample(finer + 1), level - static_cast<float>(finer));
}

/// Into [0, 1]: what repeats needs no more than one period.
float HostTexture::folded(float coordinate, Wrap wrap) {
    if (wrap == Wrap::clamp_to_edge)
        return std::isfinite(coordinate) ? std::clamp(coordinate, 0.0f, 1.0f) : 0;
    if (!(std::abs(coordinate) < whole_from)) return 0;
    const int whole = floor_of(coordinate);
    const float fraction = coordinate - static_cast<float>(whole);
    const bool turned = wrap == Wrap::mirrored_repeat && (whole & 1) != 0;
    return turned ? 1 - fraction : fraction;
}

/// Texels -1 and `size` beside a folded coordinate: the opposite ones where the texture repeats, else the
/// last ones themselves.
int HostTexture::wrapped(int texel, int size, Wrap wrap) const {
    if (wrap != Wrap::repeat) return std::clamp(texel, 0, size - 1);
    return texel < 0 ? size - 1 : texel >= size ? 0 : texel;
}

glm::vec3 HostTexture::texel(const Level& level, int x, int y) const {
    const auto* bytes =
        level.texels + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) +
                            static_cast<std::size_t>(x));
    return {values_[bytes[0]], values_[bytes[1]], values_[bytes[2]]};
}

glm::vec3 HostTexture::nearest(const Level& level, glm::vec2 uv) const {
    const int x = static_cast<int>(uv.x * static_cast<float>(level.width));
    const int y = static_cast<int>(uv.y * static_cast<float>(level.height));
    return texel(level, std::min(x, level.width - 1), std::min(y, level.height - 1));
}

glm::vec3 HostTexture::bilinear(const Level& level, glm::vec2 uv) const {
    const auto centred = uv * glm::vec2(level.width, level.height) - 0.5f;
    const int x = floor_of(centred.x), y = floor_of(centred.y);
    const auto part = centred - glm::vec2(x, y);
    const int left = wrapped(x, level.width, wrap_s_), right = wrapped(x + 1, level.width, wrap_s_);
    const int top = wrapped(y, level.height, wrap_t_), bottom = wrapped(y + 1, level.height, wrap_t_);
    const auto upper = glm::mix(texel(level, left, top), texel(level, right, top), part.x);
    return glm::mix(upper, glm::mix(texel(level, left, bottom), texel(level, right, bottom), part.x), part.y);
}

}  // namespace ir::passes
