#pragma once

#include <glm/glm.hpp>

#include "renderers/scene/scene.h"

namespace ir::passes {

/// A texture's finest level as OpenGL's samplers would show it, without a device. Keeps a pointer to the
/// texels.
class HostTexture {
  public:
    explicit HostTexture(const scene::Texture& texture);

    /// RGB at these (transformed) coordinates, sRGB decoded before filtering; bilinear where the sampler's
    /// magnification filter is linear. Coordinates that are not finite count as 0.
    /// [OpenGL 4.5 core §8.14.2, §8.24]
    glm::vec3 at(glm::vec2 uv) const {
        uv = {folded(uv.x, wrap_s_), folded(uv.y, wrap_t_)};
        return is_linear_ ? bilinear(uv) : nearest(uv);
    }

  private:
    static float folded(float coordinate, scene::Wrap wrap);
    int wrapped(int texel, int size, scene::Wrap wrap) const;
    glm::vec3 texel(int x, int y) const;
    glm::vec3 bilinear(glm::vec2 folded_uv) const;
    glm::vec3 nearest(glm::vec2 folded_uv) const;

    const std::uint8_t* texels_;
    const float* levels_;  ///< value of each byte
    int width_, height_;
    scene::Wrap wrap_s_, wrap_t_;
    bool is_linear_;
};

}  // namespace ir::passes
