#pragma once

#include <limits>
#include <span>

#include "renderers/methods/deep-screen-space/surfels/view.h"

namespace ir::methods::deep_screen_space {

/// Where the surfaces of the picture are: what reaches none of them is no use.
class WhatIsSeen {
  public:
    /// `positions`: of the G-buffer, w 0 where nothing is.
    WhatIsSeen(const scene::View& view, std::span<const glm::vec4> positions, const Parameters& parameters)
        : frustum_(frustum(view, 0, parameters)) {
        for (const auto& position : positions) {
            if (position.w == 0) continue;
            least_ = glm::min(least_, glm::vec3(position));
            most_ = glm::max(most_, glm::vec3(position));
        }
    }

    /// False where no surface lies in the sphere.
    bool may_be_reached(glm::vec3 centre_ws, float radius) const {
        const auto gap = glm::max(glm::max(least_ - centre_ws, centre_ws - most_), glm::vec3(0));
        if (!(glm::dot(gap, gap) <= 1.0001f * radius * radius)) return false;
        for (const auto& plane : frustum_.frustum)
            if (glm::dot(glm::vec3(plane), centre_ws) + plane.w < -radius - frustum_.margin) return false;
        return true;
    }

  private:
    Frustum frustum_;
    glm::vec3 least_ = glm::vec3(std::numeric_limits<float>::infinity()), most_ = -least_;
};

}  // namespace ir::methods::deep_screen_space
