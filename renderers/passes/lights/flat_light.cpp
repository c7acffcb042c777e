#include "renderers/passes/lights/flat_light.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "renderers/passes/lights/spherical_rectangle.h"
#include "renderers/passes/sampling/concentric_disk.h"
#include "renderers/scene/frame.h"

namespace ir::passes {
FlatLight::FlatLight(const scene::Light& light)
    : centre_(light.position),
      normal_(light.direction),
      radiance_(light.colour * light.intensity),
      half_size_(0.5f * light.size),
      is_disk_(light.type == scene::LightType::disk) {
    const auto frame = scene::light_frame(light);
    width_ = frame.width;
    height_ = frame.height;
    area_ = (is_disk_ ? std::numbers::pi_v<float> : 4.0f) * half_size_.x * half_size_.y;
}

glm::vec2 FlatLight::on_plane(glm::vec2 u) const {
    return half_size_ * (is_disk_ ? concentric_disk(u) : 2.0f * u - 1.0f);
}

glm::vec3 FlatLight::point_ws(glm::vec2 u) const {
    const glm::vec2 p = on_plane(u);
    return centre_ + p.x * width_ + p.y * height_;
}

bool FlatLight::uses_solid_angle(glm::vec3 position_ws) const {
    // Farther away than this many half-diagonals the density per solid angle varies by little with the point.
    constexpr float near = 6;
    const glm::vec3 offset = position_ws - centre_;
    return !is_disk_ && glm::dot(offset, offset) < near * near * glm::dot(half_size_, half_size_);
}

std::optional<FlatLightPoint> FlatLight::sample(glm::vec3 position_ws, glm::vec2 u) const {
    const glm::vec3 from_centre = position_ws - centre_;
    const float height = glm::dot(from_centre, normal_);
    if (!(height > 0) || !(area_ > 0)) return std::nullopt;
    const glm::vec2 foot(glm::dot(from_centre, width_), glm::dot(from_centre, height_));
    glm::vec2 p = on_plane(u) - foot;
    const bool by_solid_angle = uses_solid_angle(position_ws);
    double solid_angle = 0;
    if (by_solid_angle) {
        const SphericalRectangle seen(-half_size_ - foot, half_size_ - foot, height);
        solid_angle = seen.solid_angle();
        p = seen.sample(u);
    }
    const glm::vec3 offset = p.x * width_ + p.y * height_ - height * normal_;
    const float squared = glm::dot(offset, offset), distance = std::sqrt(squared);
    FlatLightPoint point{offset / distance, distance, 0};
    point.pdf = by_solid_angle ? static_cast<float>(1 / solid_angle) : squared * distance / (height * area_);
    if (!(point.pdf > 0) || !std::isfinite(point.pdf)) return std::nullopt;
    return point;
}

float FlatLight::pdf(glm::vec3 position_ws, glm::vec3 direction_ws) const {
    const auto distance = intersect(position_ws, direction_ws, std::numeric_limits<float>::infinity());
    if (!distance || !(area_ > 0)) return 0;
    const glm::vec3 from_centre = position_ws - centre_;
    const float height = glm::dot(from_centre, normal_);
    if (!uses_solid_angle(position_ws)) return *distance * *distance * *distance / (height * area_);
    const glm::vec2 foot(glm::dot(from_centre, width_), glm::dot(from_centre, height_));
    return static_cast<float>(
        1 / SphericalRectangle(-half_size_ - foot, half_size_ - foot, height).solid_angle());
}

std::optional<float> FlatLight::intersect(glm::vec3 origin_ws, glm::vec3 direction_ws, float far) const {
    const glm::vec3 from_centre = origin_ws - centre_;
    const float height = glm::dot(from_centre, normal_), fall = -glm::dot(direction_ws, normal_);
    if (!(height > 0) || !(fall > 0)) return std::nullopt;
    const float distance = height / fall;
    if (!(distance < far)) return std::nullopt;
    const glm::vec3 at = from_centre + distance * direction_ws;
    const glm::vec2 p = glm::vec2(glm::dot(at, width_), glm::dot(at, height_)) / half_size_;
    const bool inside = is_disk_ ? glm::dot(p, p) <= 1 : std::abs(p.x) <= 1 && std::abs(p.y) <= 1;
    return inside ? std::optional(distance) : std::nullopt;
}

}  // namespace ir::passes
