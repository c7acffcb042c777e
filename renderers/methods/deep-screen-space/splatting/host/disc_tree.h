#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderers/methods/deep-screen-space/splatting/host/disc_level.h"

namespace ir::methods::deep_screen_space {

/// The discs of all levels and all their sub-images in one hierarchy, for surfels that take sub-images in
/// turn. Of 4^l surfels in a row each is in another sub-image of level l, and those near each other in the
/// row lie near each other. So boxes about 4, 16, 64, … surfels in a row serve all levels: on level l a box
/// about 4^l of them has one disc of each sub-image. Thread-safe for queries.
struct DiscTree {
    static constexpr std::size_t fan = 4;

    /// Whether the surfels' numbers are their places, which it takes for granted.
    static bool fits(std::span<const Surfel> surfels);
    DiscTree(std::span<const Surfel> surfels, const VisibleLevel& rules);

    /// Boxes about centres, with how far discs of the surfels' own areas reach from these along each axis,
    /// and radii; 0 of boxes without surfels. Four in a row are one box of the next height.
    struct Height {
        std::vector<float> low[3], high[3], reach[3], least_radius, most_radius;
        explicit Height(std::size_t boxes);
        std::size_t size() const { return most_radius.size(); }
    };

    std::span<const Surfel> surfels;
    VisibleLevel rules;
    std::vector<Height> heights;  ///< of 4^(i+1) surfels; the last has four boxes
    float rounding = 0;           ///< m, of coordinates
};

/// Looks for discs with hits in (near, far) among surfels whose number modulo 4^level is `cell`.
void ask(const DiscTree& tree, DiscRay& ray, int level, std::uint32_t cell, float near, float far);

}  // namespace ir::methods::deep_screen_space
