#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace ir::passes::ldm {

/// One region of the sphere and the direction that stands for it. Angles in radians; the pole (colatitude 0)
/// is +Y, longitude 0 is +X and grows towards +Z. A polar cap spans all longitudes.
struct Direction {
    glm::dvec3 centre{0, 1, 0};  ///< unit length, in the upper half
    double colatitude_min = 0, colatitude_max = 0;
    double longitude_min = 0, longitude_max = 0;
};

/// Unit vector at these angles.
glm::dvec3 on_sphere(double colatitude, double longitude);

/// Regions per collar, from pole to pole without the two caps, of the partition of the sphere into an even
/// number of `regions`. [Leopardi06 §3]
std::vector<int> collar_counts(int regions);

/// `count` ≥ 1 directions that together with their negatives are the centres of Leopardi's recursive zonal
/// equal-area partition of the sphere into 2·count regions. Leopardi's longitude offsets are not antipodal,
/// while a map serves both v and -v: the upper half is taken and negated, and of the collar at the equator
/// every second half is left out. [Aalund15 §3.2, Leopardi06]
std::vector<Direction> leopardi_directions(int count);

/// A rotation after which collars are parallel to no floor, wall or ledge: edges that lie level, as collars
/// do, would be met by many directions at once.
glm::dmat3 tilt();

/// A random rotation, uniform over all rotations, that depends on seed and frame alone.
glm::dmat3 random_rotation(std::uint64_t seed, int frame);

}  // namespace ir::passes::ldm
