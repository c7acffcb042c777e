#pragma once

#include <glm/glm.hpp>

#include "renderers/scene/scene.h"

namespace ir::scene {

/// A camera at an image size, as matrices. Clip space as set once per context (gl::Context): y = +1 is the
/// top, row 0 of an image is its top row, depth is 0 at the near plane and 1 at the far plane.
struct View {
    int width = 0, height = 0;
    glm::vec3 eye_ws{0};
    glm::mat4 view_from_world{1}, clip_from_view{1};
    float near_plane = 0.1f, far_plane = 100;
    glm::mat4 clip_from_world() const { return clip_from_view * view_from_world; }
};

/// Near and far planes enclose the bounds.
View make_view(const Camera& camera, int width, int height, const Bounds& bounds);

/// World-space ray through a point of the image, in pixels from the top left corner.
struct Ray {
    glm::vec3 origin_ws, direction_ws;
};
Ray pixel_ray(const View& view, glm::vec2 position_px);

}  // namespace ir::scene
