#pragma once

#include <glm/glm.hpp>

namespace ir::passes {

/// A rectangle projected onto the unit sphere around a point: uniform sampling in solid angle.  [Urena13]
/// In double precision, as the solid angle is a small difference of large angles.
class SphericalRectangle {
  public:
    /// In a frame whose axes are the rectangle's: `corner` and `opposite` are corners as seen from the point,
    /// both in the plane z = distance to it, which is not 0; corner.x < opposite.x, likewise y.
    SphericalRectangle(glm::dvec2 corner, glm::dvec2 opposite, double z);

    double solid_angle() const { return solid_angle_; }  ///< sr
    /// The point (x, y) in the plane, by u in [0, 1)².
    glm::dvec2 sample(glm::dvec2 u) const;

  private:
    double x0_, y0_, x1_, y1_, z0_;
    double b0_ = 0, b1_ = 0, k_ = 0, solid_angle_ = 0;
};

}  // namespace ir::passes
