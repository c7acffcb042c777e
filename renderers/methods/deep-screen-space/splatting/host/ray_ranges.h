#pragma once

#include <array>
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

    /// Where rays begin, with what all of them share.
    struct Start {
        float along, size;  ///< m, from the eye, along the axis of view and at all
        glm::vec3 away;     ///< from the eye, unit or 0
        float exact_reach;  ///< m: how far triangles decide, where level 0 is theirs, which is as far as the
                            ///< first shell of a surfel there reaches
    };
    Start start(glm::vec3 x_ws) const;

    struct Range {
        float near = 0, far = std::numeric_limits<float>::infinity();
    };
    /// On coarser levels without hits in the shells of level 0: those level 0 has, too.
    Range of(int level, const Start& start, glm::vec3 direction_ws) const;

  private:
    /// What bounds a level; in ideal distances, but for what is in metres.
    struct Level {
        float far_m;                ///< for all rays
        float shell = 0, size = 0;  ///< beyond which no shell and no disc reaches
        float shell_radius_m = 0;   ///< which shells have at least
        float near = 0;             ///< where shells begin
        bool ends = false;          ///< by its shells
    };
    Level level(int number) const;
    float last(float beyond_m, float factor, const Start& start, float slope) const;
    float first(float factor, const Start& start, glm::vec3 direction_ws) const;

    Ideal ideal_;
    VisibleLevel rules_;
    float shells_per_radius_;  ///< 1 / √ε; 0: shells know no radius
    float least_ = std::numeric_limits<float>::infinity(), most_ = 0;  ///< radii over ideal distances
    float largest_ = 0;                                                ///< m: radius
    std::array<Level, max_levels> levels_;
};

}  // namespace ir::methods::deep_screen_space
