#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderers/passes/ldm/directions.h"
#include "renderers/scene/scene.h"

namespace ir::passes::ldm {

/// The regions of the sphere whose centres are ±v of leopardi_directions(count): where a direction lies, in a
/// time that does not depend on their number.
class Regions {
  public:
    explicit Regions(int count);
    /// 2·i is the region of direction i, 2·i + 1 that of its negative. Borders belong to either.
    std::size_t find(const glm::dvec3& direction) const;
    std::size_t size() const { return 2 * directions_.size(); }

  private:
    struct Collar {
        double top, bottom, begin, step;  ///< rad; step is that of a region
        std::size_t first, kept;
    };
    /// Of the upper half of the sphere; the last one where an angle lies below it.
    const Collar& collar_at(double colatitude) const;

    std::vector<Direction> directions_;
    std::vector<Collar> collars_;
    double height_ = 1;  ///< rad; of a collar, before areas are made equal
};

/// Mean radiance of the environment over each region, W/(m² sr), where the regions are turned by `rotation`.
/// [Aalund15 §6, "environment lighting"]
std::vector<glm::vec3> region_radiance(const scene::Environment& environment, int count,
                                       const glm::dmat3& rotation);

}  // namespace ir::passes::ldm
