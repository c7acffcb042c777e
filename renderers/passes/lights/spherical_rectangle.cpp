#include "renderers/passes/lights/spherical_rectangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ir::passes {
namespace {

double length(double a, double b) {
    return std::sqrt(a * a + b * b);
}

}  // namespace

// [Urena13 §3]: the plane lies at negative z there, and so here; the sign does not matter for (x, y).
SphericalRectangle::SphericalRectangle(glm::dvec2 corner, glm::dvec2 opposite, double z)
    : x0_(corner.x), y0_(corner.y), x1_(opposite.x), y1_(opposite.y), z0_(-std::abs(z)) {
    // Normals of the four planes through the point and an edge: only their z components count.
    const auto normal_z = [this](double edge) { return edge / length(z0_, edge); };
    b0_ = -normal_z(y0_);
    const double b1 = normal_z(x1_), b2 = normal_z(y1_), b3 = -normal_z(x0_);
    b1_ = b2;
    const auto angle = [](double a, double b) { return std::acos(std::clamp(-a * b, -1.0, 1.0)); };
    const double g0 = angle(b0_, b1), g1 = angle(b1, b2), g2 = angle(b2, b3), g3 = angle(b3, b0_);
    k_ = 2 * std::numbers::pi - g2 - g3;
    solid_angle_ = std::max(g0 + g1 - k_, 0.0);
}

glm::dvec2 SphericalRectangle::sample(glm::dvec2 u) const {
    // The part of the rectangle to the left of x has the solid angle u.x * solid_angle.  [Urena13 fig. 4]
    const double angle = u.x * solid_angle_ + k_;
    const double f = (std::cos(angle) * b0_ - b1_) / std::sin(angle);
    const double cu = std::clamp(std::copysign(1 / std::sqrt(f * f + b0_ * b0_), f), -1.0, 1.0);
    const double sine = std::sqrt(std::max(1 - cu * cu, 1e-300));
    const double x = std::clamp(-cu * z0_ / sine, x0_, x1_);
    // Uniform in the sine of the elevation along that line.
    const double d = length(x, z0_);
    const double h0 = y0_ / length(d, y0_), h1 = y1_ / length(d, y1_);
    const double h = h0 + u.y * (h1 - h0);
    const double y = h * d / std::sqrt(std::max(1 - h * h, 1e-300));
    return {x, std::clamp(y, y0_, y1_)};
}

}  // namespace ir::passes
