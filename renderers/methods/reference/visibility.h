#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderers/core/transport.h"
#include "renderers/methods/reference/estimate.h"
#include "renderers/methods/reference/progress.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/surface/surface.h"

namespace ir::methods::reference {

/// A visible point; unit normals on the viewer's side.
struct SurfacePoint {
    glm::vec3 position_ws{0}, geometric_normal_ws{0}, shading_normal_ws{0};
};

/// V as a function of the distance d of the first hit.
struct VisibilityRule {
    float max_distance = 0;  ///< d_max, metres; 0 = unlimited
    Transport::Falloff falloff = Transport::Falloff::hard;
};

/// Hard: 0 below d_max. Smooth: (d/d_max)² below d_max. 1 beyond and for d = infinity. [Aalund15 §3.3]
float visibility(const VisibilityRule& rule, float distance);

/// Maps a point of the unit square to a unit direction on the side of unit normal `n`.
using DirectionSampler = glm::vec3 (*)(glm::vec2 u, glm::vec3 n);

/// With density cosθ/π, so that AO(x) = 1/π ∫ V cosθ dω [Aalund15 eq. 1] is the plain mean of V.
glm::vec3 cosine_direction(glm::vec2 u, glm::vec3 n);

/// Sample i of a pixel for every i, in no order.
class PixelSamples {
  public:
    PixelSamples(std::uint64_t seed, std::uint32_t x, std::uint32_t y);
    glm::vec2 point(std::uint64_t sample) const;

  private:
    std::array<passes::PointSequence, randomisations> sequences_;
};

/// Adds V for these samples to their randomisations' sums; returns how many rays were asked for. A direction
/// below the geometric surface counts as closed at distance 0 and is not traced. Rays go in packets of 16
/// consecutive samples of this one pixel, the first a multiple of 16; also those of a packet that lie outside
/// the range are traced, so that a sample never depends on the range.
std::uint32_t add_visibility(const passes::Bvh& bvh, const SurfacePoint& point, const VisibilityRule& rule,
                             const PixelSamples& samples, SampleRange range, Sums& sums,
                             DirectionSampler direction = cosine_direction);

/// The world that rays through pixels meet.
struct RayWorld {
    const passes::Bvh& bvh;
    const passes::SurfaceLookup& surfaces;
};

/// The same with a ray of its own for each sample, uniform over the pixel. What misses everything is open.
std::uint32_t add_visibility_through_pixel(const RayWorld& world, const passes::PixelRays& rays,
                                           glm::ivec2 pixel, std::uint64_t pixel_key,
                                           const VisibilityRule& rule, SampleRange range, Sums& sums);

}  // namespace ir::methods::reference
