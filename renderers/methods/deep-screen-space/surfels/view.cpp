#include "renderers/methods/deep-screen-space/surfels/view.h"

#include <array>
#include <cmath>

namespace ir::methods::deep_screen_space {
namespace {

constexpr int plane_count = 6;

/// Planes of the frustum with unit normals inwards.
std::array<glm::vec4, plane_count> planes_of(const scene::View& view) {
    const auto rows = glm::transpose(glm::dmat4(view.clip_from_view) * glm::dmat4(view.view_from_world));
    const std::array<glm::dvec4, plane_count> sums{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                                   rows[3] - rows[1], rows[2],           rows[3] - rows[2]};
    std::array<glm::vec4, plane_count> planes;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const double size = glm::length(glm::dvec3(sums[i]));
        planes[i] = glm::vec4(size > 0 ? sums[i] / size : glm::dvec4(0));
    }
    return planes;
}

}  // namespace

void set_ideal(const gl::Program& program, const graph::FrameInputs& inputs, const Parameters& parameters) {
    const auto& view = inputs.view;
    const auto& projection = view.clip_from_view;
    const bool perspective = projection[3][3] == 0;
    const float pixel = 2 / (projection[1][1] * static_cast<float>(view.height));
    const glm::vec2 corner(1 / projection[0][0], 1 / projection[1][1]);
    const auto world_from_view = glm::transpose(glm::mat3(view.view_from_world));
    program.set("ideal_eye_ws", view.eye_ws);
    program.set("ideal_axis_ws", perspective ? -world_from_view[2] : glm::vec3(0));
    program.set("ideal_radius", parameters.surfel_radius * pixel);
    program.set("ideal_corner_cosine", 1 / std::sqrt(1 + glm::dot(corner, corner)));
    program.set("ideal_nearest", view.near_plane);
}

void set_frustum(const gl::Program& program, const graph::FrameInputs& inputs, float reach,
                 const Parameters& parameters) {
    const auto planes = planes_of(inputs.view);
    for (int i = 0; i < plane_count; ++i)
        program.set(("frustum[" + std::to_string(i) + "]").c_str(), planes[static_cast<std::size_t>(i)]);
    const float rounding = 1e-4f * (reach + inputs.view.far_plane + glm::length(inputs.view.eye_ws));
    program.set("culls", parameters.frustum_culling ? 1 : 0);
    program.set("margin", reach + rounding);
}

}  // namespace ir::methods::deep_screen_space
