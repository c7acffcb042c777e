#include "renderers/passes/surface/host_texture.h"

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

/// std::floor without a call; `x` fits an int.
int floor_of(float x) {
    const int truncated = static_cast<int>(x);
    return truncated - (static_cast<float>(truncated) > x);
}

/// From here on floats are whole numbers, which repeat as 0.
constexpr float whole_from = 8388608.0f;

}  // namespace

HostTexture::HostTexture(const scene::Texture& texture)
    : texels_(texture.rgba.data()),
      levels_(levels_of(texture.srgb)),
      width_(texture.width),
      height_(texture.height),
      wrap_s_(texture.sampler.wrap_s),
      wrap_t_(texture.sampler.wrap_t),
      is_linear_(texture.sampler.mag == scene::Filter::linear) {}

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

glm::vec3 HostTexture::texel(int x, int y) const {
    const auto* bytes = texels_ + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                       static_cast<std::size_t>(x));
    return {levels_[bytes[0]], levels_[bytes[1]], levels_[bytes[2]]};
}

glm::vec3 HostTexture::nearest(glm::vec2 uv) const {
    const int x = static_cast<int>(uv.x * static_cast<float>(width_));
    const int y = static_cast<int>(uv.y * static_cast<float>(height_));
    return texel(std::min(x, width_ - 1), std::min(y, height_ - 1));
}

glm::vec3 HostTexture::bilinear(glm::vec2 uv) const {
    const auto centred = uv * glm::vec2(width_, height_) - 0.5f;
    const int x = floor_of(centred.x), y = floor_of(centred.y);
    const auto part = centred - glm::vec2(x, y);
    const int left = wrapped(x, width_, wrap_s_), right = wrapped(x + 1, width_, wrap_s_);
    const int top = wrapped(y, height_, wrap_t_), bottom = wrapped(y + 1, height_, wrap_t_);
    const auto upper = glm::mix(texel(left, top), texel(right, top), part.x);
    return glm::mix(upper, glm::mix(texel(left, bottom), texel(right, bottom), part.x), part.y);
}

}  // namespace ir::passes
