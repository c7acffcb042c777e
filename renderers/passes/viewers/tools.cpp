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

Eye eye(const Sight& sight) {
    return {sight.view.eye_ws, sight.axis_ws, sight.orthographic};
}

Projection projection(const Sight& sight) {
    return {eye(sight), sight.view.clip_from_world(), glm::vec2(sight.view.width, sight.view.height),
            sight.orthographic ? 0.5f : sight.view.near_plane};
}

Shade shade(const Sight& sight) {
    return {sight.view.eye_ws, sight.axis_ws, sight.light_ws, sight.orthographic};
}

}  // namespace ir::passes::viewers
