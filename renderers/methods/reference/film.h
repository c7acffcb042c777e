#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "renderers/scene/view.h"

namespace ir::methods::reference {

/// What a view sees of points: the inverse of passes::pixel_rays().
class Film {
  public:
    struct Seen {
        glm::vec3 to_eye_ws{0};  ///< unit
        float distance = 0;      ///< m, to the eye; of orthographic views to its plane
        std::uint32_t pixel = 0;
        /// Density of the pixel's box filter for directions at the eye over the squared distance, 1/m²:
        /// radiance that leaves dA towards the eye adds importance · cosθ · dA to the pixel's mean.
        float importance = 0;
    };
    explicit Film(const scene::View& view);
    std::size_t pixels() const {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    }
    /// Nothing outside the picture and behind the eye.
    std::optional<Seen> see(glm::vec3 position_ws) const;

  private:
    glm::vec3 origin_{0}, axis_{0};
    glm::mat3 film_from_world_{1};
    float pixel_area_ = 1;  ///< m², of orthographic views; of others at depth 1
    int width_ = 0, height_ = 0;
    bool is_orthographic_ = false;
};

}  // namespace ir::methods::reference
