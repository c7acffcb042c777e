#include "renderers/scene/view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace ir::scene {
namespace {

/// Distances of the bounds' corners in front of the eye.
std::pair<float, float> depth_range(const Bounds& bounds, glm::vec3 eye, glm::vec3 forward) {
    float nearest = INFINITY, farthest = -INFINITY;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner((i & 1) ? bounds.max.x : bounds.min.x, (i & 2) ? bounds.max.y : bounds.min.y,
                               (i & 4) ? bounds.max.z : bounds.min.z);
        const float depth = glm::dot(corner - eye, forward);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    return {nearest, farthest};
}

void set_planes(View& view, const Bounds& bounds, glm::vec3 forward) {
    const auto [nearest, farthest] = depth_range(bounds, view.eye_ws, forward);
    const float margin = 1e-3f * std::max(farthest - nearest, 1e-3f);
    view.far_plane = farthest > 0 ? farthest + margin : 1.0f;  // everything behind the eye: any range will do
    // A ratio of 1e-4 leaves 32-bit depths enough resolution everywhere.
    view.near_plane = std::max(nearest - margin, 1e-4f * view.far_plane);
}

/// An up vector that is not parallel to the direction of view.
glm::vec3 usable_up(glm::vec3 up, glm::vec3 forward) {
    const auto side = glm::cross(forward, up);
    if (glm::length(side) > 1e-5f * glm::length(up)) return up;
    return std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1);
}

}  // namespace

View make_view(const Camera& camera, int width, int height, const Bounds& bounds) {
    View view;
    view.width = width;
    view.height = height;
    view.eye_ws = camera.eye;
    const auto towards = camera.target - camera.eye;
    const float distance = glm::length(towards);
    const auto forward = distance > 0 ? towards / distance : glm::vec3(0, 0, -1);
    view.view_from_world = glm::lookAtRH(camera.eye, camera.eye + forward, usable_up(camera.up, forward));
    set_planes(view, bounds, forward);
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    if (camera.orthographic) {
        const float y = 0.5f * camera.height, x = y * aspect;
        view.clip_from_view = glm::orthoRH_ZO(-x, x, -y, y, view.near_plane, view.far_plane);
    } else {
        view.clip_from_view = glm::perspectiveRH_ZO(camera.fov_y, aspect, view.near_plane, view.far_plane);
    }
    return view;
}

Ray pixel_ray(const View& view, glm::vec2 position_px) {
    const auto fraction = position_px / glm::vec2(view.width, view.height);
    const glm::vec2 ndc(2 * fraction.x - 1, 1 - 2 * fraction.y);
    const auto& projection = view.clip_from_view;
    const glm::vec3 lateral_vs(ndc.x / projection[0][0], ndc.y / projection[1][1], 0);
    const auto world_from_view = glm::transpose(glm::mat3(view.view_from_world));
    const glm::vec3 forward_vs(0, 0, -1);
    const bool orthographic = projection[3][3] == 1;
    if (orthographic) return {view.eye_ws + world_from_view * lateral_vs, world_from_view * forward_vs};
    return {view.eye_ws, glm::normalize(world_from_view * (lateral_vs + forward_vs))};
}

}  // namespace ir::scene
