#include "renderers/methods/reference/film.h"

#include "renderers/passes/gbuffer/pixel_rays.h"

namespace ir::methods::reference {

Film::Film(const scene::View& view) : width_(view.width), height_(view.height) {
    const auto rays = passes::pixel_rays(view);
    is_orthographic_ = rays.direction_dx == glm::vec3(0);
    const auto dx = is_orthographic_ ? rays.origin_dx : rays.direction_dx,
               dy = is_orthographic_ ? rays.origin_dy : rays.direction_dy;
    origin_ = rays.origin;
    axis_ = rays.direction;
    film_from_world_ = glm::inverse(glm::mat3(rays.direction, dx, dy));
    pixel_area_ = glm::length(glm::cross(dx, dy));
}

std::optional<Film::Seen> Film::see(glm::vec3 position_ws) const {
    const auto at = film_from_world_ * (position_ws - origin_);
    const float depth = at.x;
    if (!(depth > 0)) return std::nullopt;
    const auto pixel = is_orthographic_ ? glm::vec2(at.y, at.z) : glm::vec2(at.y, at.z) / depth;
    if (!(pixel.x >= 0 && pixel.x < static_cast<float>(width_) && pixel.y >= 0 &&
          pixel.y < static_cast<float>(height_)))
        return std::nullopt;
    Seen seen;
    seen.pixel = static_cast<std::uint32_t>(pixel.y) * static_cast<std::uint32_t>(width_) +
                 static_cast<std::uint32_t>(pixel.x);
    if (is_orthographic_) {
        seen.to_eye_ws = -axis_;
        seen.distance = depth;
        seen.importance = 1 / pixel_area_;
        return seen;
    }
    const auto way = origin_ - position_ws;
    seen.distance = glm::length(way);
    seen.to_eye_ws = way / seen.distance;
    // A pixel of area A at depth 1 has the solid angle A cos³ of the angle to the axis, cos = depth /
    // distance.
    seen.importance = seen.distance / (pixel_area_ * depth * depth * depth);
    return seen;
}

}  // namespace ir::methods::reference
