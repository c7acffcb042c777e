#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderers/scene/scene.h"

namespace ir::passes {

/// A point on a flat light, seen from elsewhere.
struct FlatLightPoint {
    glm::vec3 direction_ws{0};  ///< unit, towards it
    float distance = 0;
    float pdf = 0;  ///< per solid angle
};

/// A rectangle (by its sides) or a disk (an ellipse, by its diameters) that sends the same radiance from all
/// points in all directions of the side to which `normal_ws` points.
class FlatLight {
  public:
    explicit FlatLight(const scene::Light& light);

    glm::vec3 radiance() const { return radiance_; }
    glm::vec3 centre_ws() const { return centre_; }
    glm::vec3 normal_ws() const { return normal_; }
    glm::vec3 half_width_ws() const { return half_size_.x * width_; }
    glm::vec3 half_height_ws() const { return half_size_.y * height_; }
    float area() const { return area_; }             ///< m²
    glm::vec3 width_ws() const { return width_; }    ///< unit
    glm::vec3 height_ws() const { return height_; }  ///< unit
    glm::vec2 half_size() const { return half_size_; }
    bool is_disk() const { return is_disk_; }

    /// A point of it by u in [0, 1)², uniformly in area.
    glm::vec3 point_ws(glm::vec2 u) const;
    /// A point on it as it is seen, by u in [0, 1)²: rectangles that are near uniformly in solid angle
    /// [Urena13], others and disks uniformly in area. Nothing from behind and in its plane.
    std::optional<FlatLightPoint> sample(glm::vec3 position_ws, glm::vec2 u) const;
    /// Density per solid angle with which sample() chooses the direction; 0 where it misses the light.
    float pdf(glm::vec3 position_ws, glm::vec3 direction_ws) const;
    /// Distance along the unit direction to the side that sends light, within (0, far).
    std::optional<float> intersect(glm::vec3 origin_ws, glm::vec3 direction_ws, float far) const;

  private:
    glm::vec2 on_plane(glm::vec2 u) const;  ///< m from the centre, along width and height
    bool uses_solid_angle(glm::vec3 position_ws) const;
    glm::vec3 centre_, normal_, width_, height_, radiance_;
    glm::vec2 half_size_;
    float area_ = 0;
    bool is_disk_ = false;
};

}  // namespace ir::passes
