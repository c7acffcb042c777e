#pragma once

#include <limits>
#include <span>

#include "renderers/methods/deep-screen-space/splatting/host/splat_rules.h"
#include "renderers/methods/deep-screen-space/surfels/view.h"
#include "renderers/scene/view.h"

namespace ir::methods::deep_screen_space {

/// Between which distances along a ray a level can have hits, so that no more of the scene is searched. The
/// radius of a surfel follows the ideal distance of its centre [ideal.glsl], which is the largest of three
/// functions that grow at most as fast as one moves.
class RayRanges {
  public:
    RayRanges(const scene::View& view, const VisibleLevel& rules, std::span<const Surfel> surfels,
              const Parameters& parameters);

    struct Range {
        float near = 0, far = std::numeric_limits<float>::infinity();
    };
    /// How far from a point the triangles decide, where level 0 is theirs: as far as the first shell of a
    /// surfel there reaches.
    float exact_reach(glm::vec3 x_ws) const;

    /// On coarser levels without hits in the shells of level 0: those level 0 has, too.
    Range of(int level, glm::vec3 x_ws, glm::vec3 direction_ws) const;

  private:
    float last(float beyond, float factor, glm::vec3 x_ws, glm::vec3 direction_ws) const;
    float first(float factor, glm::vec3 x_ws, glm::vec3 direction_ws) const;

    Ideal ideal_;
    VisibleLevel rules_;
    float shells_per_radius_;  ///< 1 / √ε; 0: shells know no radius
    float least_ = std::numeric_limits<float>::infinity(), most_ = 0;  ///< radii over ideal distances
    float largest_ = 0;                                                ///< m: radius
};

}  // namespace ir::methods::deep_screen_space
