#pragma once

#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/parameters.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

namespace ir::methods::photon_mapping {

/// Pixels of the view along a side of a texel.
int divisor_of(SplatResolution resolution);

/// Texels of a picture of this view. The last of a row may reach beyond the picture.
glm::ivec2 texels_of(const scene::View& view, int divisor);

/// Texel of the pixel that is explained; negative: none.
glm::ivec2 picked_texel(const graph::FrameInputs& inputs, int divisor);

/// Along a side of a texel, the pixel that it stands for: kernels are summed for that pixel's surface.
int pixel_of_texel(int divisor);

/// Takes world space to the clip space of those texels, with the middles of their pixels in theirs.
glm::mat4 clip_from_world(const scene::View& view, int divisor);

/// Share of the picture that a square with so many pixels a side has, times 4 tan(α_x/2) tan(α_y/2), or times
/// the height and width (m) of a parallel view: c_tile.  [Smal19 §6.1.1]
float area_constant(const scene::View& view, int pixels);

/// Constants of shaders/methods/photon-mapping/splatting/splat_view.glsl.
struct SplatView {
    glm::mat4 clip_from_world;
    glm::vec3 eye_ws, view_axis_ws;
    glm::vec2 size_texels;
    float near_plane, far_plane;
    bool perspective;
    int divisor, pixel_of_texel;
    IR_FIELDS(clip_from_world, eye_ws, view_axis_ws, size_texels, near_plane, far_plane, perspective, divisor,
              pixel_of_texel)
};
SplatView splat_view(const scene::View& view, int divisor);

/// Constants of photon_kernel.glsl and inside.glsl beside it.
struct KernelRules {
    SplatView view;
    passes::PixelRays rays;
    float power_unit, c_tile, c_texel;
    int tile_size;
    float l_max, r_min, r_max, min_ray_length_scale, n_tile, s_n, s_max, min_radius_texels, shrinking;
    IR_FIELDS(view, rays, power_unit, c_tile, c_texel, tile_size, l_max, r_min, r_max, min_ray_length_scale,
              n_tile, s_n, s_max, min_radius_texels, shrinking)
};

KernelRules kernel_rules(const graph::FrameInputs& inputs, const Parameters& parameters, float power_unit);

}  // namespace ir::methods::photon_mapping
