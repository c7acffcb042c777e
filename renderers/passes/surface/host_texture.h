#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderers/scene/scene.h"

namespace ir::passes {

/// A texture as OpenGL's samplers would show it, without a device.
class HostTexture {
  public:
    enum class Levels {
        finest,  ///< alone; keeps a pointer to the texels
        all      ///< copies of them and of all coarser levels, where the sampler has mip maps
    };
    explicit HostTexture(const scene::Texture& texture, Levels levels = Levels::finest);
    HostTexture(HostTexture&&) = default;
    HostTexture& operator=(HostTexture&&) = default;

    /// RGB at these (transformed) coordinates, sRGB decoded before filtering; bilinear where the sampler's
    /// magnification filter is linear. Coordinates that are not finite count as 0.
    /// [OpenGL 4.5 core §8.14.2, §8.24]
    glm::vec3 at(glm::vec2 uv) const {
        uv = {folded(uv.x, wrap_s_), folded(uv.y, wrap_t_)};
        return is_linear_ ? bilinear(finest_, uv) : nearest(finest_, uv);
    }
    /// Of the levels that fit a pixel in which uv changes by these amounts from column to column and from row
    /// to row. [OpenGL 4.5 core §8.14.1, §8.14.3]
    glm::vec3 at(glm::vec2 uv, glm::vec2 by_column, glm::vec2 by_row) const;
    std::uint64_t bytes() const;  ///< of what it holds itself

  private:
    struct Level {
        const std::uint8_t* texels = nullptr;
        int width = 0, height = 0;
    };
    using Bytes = std::vector<std::uint8_t>;
    Bytes halved(const Level& level, int width, int height, bool srgb) const;
    static float folded(float coordinate, scene::Wrap wrap);
    int wrapped(int texel, int size, scene::Wrap wrap) const;
    glm::vec3 texel(const Level& level, int x, int y) const;
    glm::vec3 bilinear(const Level& level, glm::vec2 folded_uv) const;
    glm::vec3 nearest(const Level& level, glm::vec2 folded_uv) const;

    Level finest_;
    std::vector<Level> coarser_;  ///< each half the one before
    std::vector<Bytes> own_;      ///< texels of levels
    const float* values_;         ///< of each byte
    scene::Wrap wrap_s_, wrap_t_;
    bool is_linear_, is_linear_when_small_;
};

}  // namespace ir::passes
