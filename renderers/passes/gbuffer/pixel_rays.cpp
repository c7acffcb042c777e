#include "renderers/passes/gbuffer/pixel_rays.h"

#include <glm/gtc/matrix_transform.hpp>

namespace ir::passes {

PixelRays pixel_rays(const scene::View& view) {
    const glm::dmat4 projection(view.clip_from_view), world(glm::inverse(glm::dmat4(view.view_from_world)));
    const bool orthographic = projection[3][3] != 0;
    // view-space xy, at depth 1 for a perspective view, of the upper left corner and one pixel's steps
    const glm::dvec2 scale(projection[0][0], projection[1][1]);
    const glm::dvec2 centre = orthographic ? -glm::dvec2(projection[3]) : glm::dvec2(projection[2]);
    const glm::dvec2 corner = (glm::dvec2(-1, 1) + centre) / scale;
    const glm::dvec2 step = glm::dvec2(2.0 / view.width, -2.0 / view.height) / scale;

    const auto to_world = [&](double x, double y, double z) {
        return glm::vec3(world * glm::dvec4(x, y, z, 0));
    };
    const glm::dvec3 eye(world[3]);
    PixelRays rays;
    if (orthographic) {
        rays.origin = glm::vec3(eye + glm::dvec3(world * glm::dvec4(corner, 0, 0)));
        rays.origin_dx = to_world(step.x, 0, 0);
        rays.origin_dy = to_world(0, step.y, 0);
        rays.direction = to_world(0, 0, -1);
    } else {
        rays.origin = glm::vec3(eye);
        rays.direction = to_world(corner.x, corner.y, -1);
        rays.direction_dx = to_world(step.x, 0, 0);
        rays.direction_dy = to_world(0, step.y, 0);
    }
    return rays;
}

glm::mat4 pixel_from_world(const scene::View& view) {
    const glm::vec3 half_size(0.5f * static_cast<float>(view.width), 0.5f * static_cast<float>(view.height),
                              1);
    auto pixel_from_clip = glm::scale(glm::mat4(1), half_size);
    pixel_from_clip = glm::scale(glm::translate(pixel_from_clip, {1, 1, 0}), {1, -1, 1});
    return pixel_from_clip * view.clip_from_world();
}

Viewer viewer(const scene::View& view) {
    const bool orthographic = view.clip_from_view[3][3] != 0;
    const auto axis = -glm::vec3(glm::transpose(view.view_from_world)[2]);
    return {view.eye_ws, orthographic ? axis : glm::vec3(0)};
}

}  // namespace ir::passes
