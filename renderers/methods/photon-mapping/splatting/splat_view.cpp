#include "renderers/methods/photon-mapping/splatting/splat_view.h"

namespace ir::methods::photon_mapping {
namespace {

bool is_perspective(const scene::View& view) {
    return view.clip_from_view[3][3] == 0;
}

/// A scene without extent still has a size to measure radii by.
float scene_radius(const graph::FrameInputs& inputs) {
    return std::max(inputs.world->bounds.radius(), 1e-6f);
}

}  // namespace

int divisor_of(SplatResolution resolution) {
    return 1 << static_cast<int>(resolution);
}

glm::ivec2 texels_of(const scene::View& view, int divisor) {
    return (glm::ivec2(view.width, view.height) + divisor - 1) / divisor;
}

glm::mat4 clip_from_world(const scene::View& view, int divisor) {
    const auto share = glm::vec2(view.width, view.height) / glm::vec2(divisor * texels_of(view, divisor));
    glm::mat4 texels_from_picture(1);  // the upper left corner (-1, 1) stays where it is
    texels_from_picture[0][0] = share.x;
    texels_from_picture[3][0] = share.x - 1;
    texels_from_picture[1][1] = share.y;
    texels_from_picture[3][1] = 1 - share.y;
    return texels_from_picture * view.clip_from_world();
}

float area_constant(const scene::View& view, int pixels) {
    const auto& p = view.clip_from_view;
    const double share = double(pixels) * pixels / (double(view.width) * view.height);
    return static_cast<float>(4 * share / (double(p[0][0]) * p[1][1]));
}

void set_splat_view(const gl::Program& program, const graph::FrameInputs& inputs, int divisor) {
    const auto& view = inputs.view;
    program.set("clip_from_world", clip_from_world(view, divisor));
    program.set("eye_ws", view.eye_ws);
    program.set("view_axis_ws", -glm::vec3(glm::transpose(view.view_from_world)[2]));
    program.set("size_texels", glm::vec2(texels_of(view, divisor)));
    program.set("near_plane", view.near_plane);
    program.set("far_plane", view.far_plane);
    program.set("perspective", is_perspective(view) ? 1 : 0);
    program.set("divisor", divisor);
}

void set_kernel(const gl::Program& program, const graph::FrameInputs& inputs, const Parameters& parameters,
                float power_unit) {
    const int divisor = divisor_of(parameters.splat_resolution);
    const float radius = scene_radius(inputs);
    set_splat_view(program, inputs, divisor);
    program.set("power_unit", power_unit);
    program.set("c_tile", area_constant(inputs.view, parameters.tile_size * divisor));
    program.set("c_texel", area_constant(inputs.view, divisor));
    program.set("tile_size", parameters.tile_size);
    program.set("l_max", parameters.ray_length_scale * radius);
    program.set("r_min", parameters.radius_min * radius);
    program.set("r_max", std::max(parameters.radius_min, parameters.radius_max) * radius);
    program.set("ray_length_floor", parameters.ray_length_floor);
    program.set("n_tile", parameters.kernel_scale);
    program.set("s_n", parameters.normal_axis);
    program.set("s_max", parameters.stretch_max);
    program.set("radius_texels", parameters.radius_texels);
}

}  // namespace ir::methods::photon_mapping
