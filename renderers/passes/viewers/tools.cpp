#include "renderers/passes/viewers/tools.h"

namespace ir::passes::viewers {

Sight make_sight(const scene::Camera& camera, int width, int height, int oversampling,
                 const scene::Bounds& bounds) {
    Sight sight;
    sight.view = scene::make_view(camera, width * oversampling, height * oversampling, bounds);
    sight.pixel_samples = oversampling;
    sight.orthographic = camera.orthographic;
    const auto world_from_view = glm::transpose(glm::mat3(sight.view.view_from_world));
    sight.axis_ws = -world_from_view[2];
    // over the viewer's left shoulder, so that walls, floors and ceilings differ
    sight.light_ws = world_from_view * glm::normalize(glm::vec3(-0.35f, 0.55f, 1));
    return sight;
}

void set_projection(const gl::Program& program, const Sight& sight) {
    program.set("clip_from_world", sight.view.clip_from_world());
    program.set("size_px", glm::vec2(sight.view.width, sight.view.height));
    program.set("min_w", sight.orthographic ? 0.5f : sight.view.near_plane);
}

void set_shade(const gl::Program& program, const Sight& sight) {
    program.set("shade_eye_ws", sight.view.eye_ws);
    program.set("shade_axis_ws", sight.axis_ws);
    program.set("shade_light_ws", sight.light_ws);
    program.set("shade_orthographic", sight.orthographic ? 1 : 0);
}

void set_eye(const gl::Program& program, const Sight& sight) {
    program.set("eye_ws", sight.view.eye_ws);
    program.set("view_axis_ws", sight.axis_ws);
    program.set("orthographic", sight.orthographic ? 1 : 0);
}

}  // namespace ir::passes::viewers
