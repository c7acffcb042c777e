#pragma once

#include "renderers/gl/program.h"
#include "renderers/scene/view.h"

namespace ir::passes {

/// The rays through the pixels of a view as functions that are linear in the pixel: origin + x origin_dx +
/// y origin_dy, and direction likewise, x and y in pixels from the upper left corner (world space, m).
/// Directions advance by 1 along the view axis, so that a ray's parameter is the depth in view space.
struct PixelRays {
    glm::vec3 origin{0}, origin_dx{0}, origin_dy{0};
    glm::vec3 direction{0}, direction_dx{0}, direction_dy{0};
};
PixelRays pixel_rays(const scene::View& view);

/// Homogeneous pixels, from the upper left corner, of points in world space; w as in clip space.
glm::mat4 pixel_from_world(const scene::View& view);

/// Sets the uniforms that shaders/lib/pixel_rays.glsl declares.
void set_pixel_rays(const gl::Program& program, const scene::View& view);

}  // namespace ir::passes
