#pragma once

#include "renderers/core/fields.h"
#include "renderers/scene/view.h"

namespace ir::passes {

/// The rays through the pixels of a view as functions that are linear in the pixel: origin + x origin_dx +
/// y origin_dy, and direction likewise, x and y in pixels from the upper left corner (world space, m).
/// Directions advance by 1 along the view axis, so that a ray's parameter is the depth in view space.
struct PixelRays {
    glm::vec3 origin{0}, origin_dx{0}, origin_dy{0};
    glm::vec3 direction{0}, direction_dx{0}, direction_dy{0};

    /// As IR_FIELDS: constants of shaders/lib/pixel_rays.glsl, where the names begin with ray_.
    static constexpr const char* field_names() {
        return "ray_origin_ws, ray_origin_dx, ray_origin_dy, ray_direction_ws, ray_direction_dx, "
               "ray_direction_dy";
    }
    auto fields() const {
        return std::tie(origin, origin_dx, origin_dy, direction, direction_dx, direction_dy);
    }
};
PixelRays pixel_rays(const scene::View& view);

/// Where surfaces are seen from: constants of shaders that ask for the direction to the eye.
struct Viewer {
    glm::vec3 eye_ws, view_axis_ws;  ///< axis of an orthographic view; 0 for a perspective one
    IR_FIELDS(eye_ws, view_axis_ws)
    /// Unit direction to the viewer.
    glm::vec3 seen_from(glm::vec3 p) const {
        return view_axis_ws == glm::vec3(0) ? glm::normalize(eye_ws - p) : -view_axis_ws;
    }
};
Viewer viewer(const scene::View& view);

/// Homogeneous pixels, from the upper left corner, of points in world space; w as in clip space.
glm::mat4 pixel_from_world(const scene::View& view);

}  // namespace ir::passes
