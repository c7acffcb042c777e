#include "renderers/methods/photon-mapping/splatting/splat_view.h"

#include "renderers/passes/scene/progressive.h"

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

glm::ivec2 picked_texel(const graph::FrameInputs& inputs, int divisor) {
    const auto pixel = inputs.picked_pixel();
    return pixel.x < 0 ? pixel : pixel / divisor;
}

int pixel_of_texel(int divisor) {
    return (divisor - 1) / 2;
}

glm::mat4 clip_from_world(const scene::View& view, int divisor) {
    const auto pixels = glm::vec2(divisor * texels_of(view, divisor));
    const auto share = glm::vec2(view.width, view.height) / pixels;
    const auto shift = (float(2 * pixel_of_texel(divisor) + 1 - divisor)) / pixels;
    glm::mat4 texels_from_picture(1);  // the upper left corner (-1, 1) stays where it is, but for the shift
    texels_from_picture[0][0] = share.x;
    texels_from_picture[3][0] = share.x - 1 - shift.x;
    texels_from_picture[1][1] = share.y;
    texels_from_picture[3][1] = 1 - share.y + shift.y;
    return texels_from_picture * view.clip_from_world();
}

float area_constant(const scene::View& view, int pixels) {
    const auto& p = view.clip_from_view;
    const double share = double(pixels) * pixels / (double(view.width) * view.height);
    return static_cast<float>(4 * share / (double(p[0][0]) * p[1][1]));
}

SplatView splat_view(const scene::View& view, int divisor) {
    return {.clip_from_world = clip_from_world(view, divisor),
            .eye_ws = view.eye_ws,
            .view_axis_ws = -glm::vec3(glm::transpose(view.view_from_world)[2]),
            .size_texels = glm::vec2(texels_of(view, divisor)),
            .near_plane = view.near_plane,
            .far_plane = view.far_plane,
            .perspective = is_perspective(view),
            .divisor = divisor,
            .pixel_of_texel = pixel_of_texel(divisor)};
}

KernelRules kernel_rules(const graph::FrameInputs& inputs, const Parameters& parameters, float power_unit) {
    const int divisor = divisor_of(parameters.splat_resolution);
    const float radius = scene_radius(inputs);
    return {.view = splat_view(inputs.view, divisor),
            .rays = passes::pixel_rays(inputs.view),
            .power_unit = power_unit,
            .c_tile = area_constant(inputs.view, parameters.tile_size * divisor),
            .c_texel = area_constant(inputs.view, divisor),
            .tile_size = parameters.tile_size,
            .l_max = parameters.ray_length_scale * radius,
            .r_min = parameters.min_radius * radius,
            .r_max = std::max(parameters.min_radius, parameters.max_radius) * radius,
            .min_ray_length_scale = parameters.min_ray_length_scale,
            .n_tile = parameters.kernel_scale,
            .s_n = parameters.normal_axis,
            .s_max = parameters.max_stretch,
            .min_radius_texels = parameters.min_radius_texels,
            .shrinking =
                parameters.is_progressive()
                    ? passes::progressive_shrinking(passes::frames_standing(inputs), parameters.radius_decay)
                    : 1};
}

}  // namespace ir::methods::photon_mapping
