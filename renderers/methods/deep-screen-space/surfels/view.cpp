#include "renderers/methods/deep-screen-space/surfels/view.h"

#include <cmath>

namespace ir::methods::deep_screen_space {
namespace {

std::array<glm::vec4, 6> planes_of(const scene::View& view) {
    const auto rows = glm::transpose(glm::dmat4(view.clip_from_view) * glm::dmat4(view.view_from_world));
    const std::array<glm::dvec4, 6> sums{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                         rows[3] - rows[1], rows[2],           rows[3] - rows[2]};
    std::array<glm::vec4, 6> planes;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const double size = glm::length(glm::dvec3(sums[i]));
        planes[i] = glm::vec4(size > 0 ? sums[i] / size : glm::dvec4(0));
    }
    return planes;
}

}  // namespace

Ideal ideal(const scene::View& view, const Parameters& parameters) {
    const auto& projection = view.clip_from_view;
    const bool perspective = projection[3][3] == 0;
    const float pixel = 2 / (projection[1][1] * static_cast<float>(view.height));
    const glm::vec2 corner(1 / projection[0][0], 1 / projection[1][1]);
    const auto world_from_view = glm::transpose(glm::mat3(view.view_from_world));
    return {.ideal_eye_ws = view.eye_ws,
            .ideal_axis_ws = perspective ? -world_from_view[2] : glm::vec3(0),
            .ideal_radius = parameters.surfel_radius * pixel,
            .ideal_corner_cosine = 1 / std::sqrt(1 + glm::dot(corner, corner)),
            .ideal_nearest = view.near_plane};
}

Frustum frustum(const scene::View& view, float reach, const Parameters& parameters) {
    const float rounding = 1e-4f * (reach + view.far_plane + glm::length(view.eye_ws));
    return {planes_of(view), parameters.frustum_culling, reach + rounding};
}

}  // namespace ir::methods::deep_screen_space
