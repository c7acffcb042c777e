// The kernels of the stored photons under the frame's settings.
#include "methods/photon-mapping/records.glsl"
#include "methods/photon-mapping/splatting/kernel.glsl"
#include "methods/photon-mapping/splatting/splat_view.glsl"

layout(std430) readonly buffer Photons { Photon photons[]; };
layout(std430) readonly buffer Stored { uint stored; };  // at most the buffer's capacity

uniform usampler2D tiles;

uniform float power_unit;  // W
uniform float c_tile, c_texel;
uniform int tile_size;
uniform float l_max, r_min, r_max;  // m
uniform float min_ray_length_scale, n_tile, s_n, s_max, min_radius_texels;
uniform float shrinking;  // of all radii: below 1 in later frames of a picture that converges

struct Kernel {
    vec3 centre_ws;
    vec3 n_ws, u_ws, t_ws;  // unit; u, t, n are right-handed
    vec3 axes;              // half-axes along u, t, n
    vec3 irradiance;        // W/m² where it covers
    float radius;           // s_l s_d
};

/// Photons in the tile of a place; at least the one that asks, which may be outside the picture.
float photons_of_tile(vec3 position_ws) {
    ivec2 tile = ivec2(texel_at(position_ws) / float(tile_size));
    return max(1.0, float(texelFetch(tiles, clamp(tile, ivec2(0), textureSize(tiles, 0) - 1), 0).r));
}

/// s_l s_d.
/// DEVIATION [Smal19 §6.1]: never below min_radius_texels. A kernel that is smaller than a texel is seen by few
/// texels' middles and there counts for all of the texel: the mean is the same, with more noise, and such peaks
/// overflow half floats. With 0.71 texels in place of 0.2 the noise is 3.4 times less.
float kernel_radius(Photon photon) {
    float depth = view_depth(photon.position_ws);
    float r = density_radius(tile_area(depth, c_tile, perspective), photons_of_tile(photon.position_ws));
    float s_l = ray_length_scale(photon.ray_length, l_max, min_ray_length_scale);
    float texel = sqrt(tile_area(depth, c_texel, perspective));
    return shrinking * max(s_l * density_scale(r, r_min, r_max, n_tile), min_radius_texels * texel);
}

/// [Smal19 §6.1.2]
Kernel kernel_of(Photon photon) {
    Kernel k;
    k.centre_ws = photon.position_ws;
    k.n_ws = normal_of(photon);
    vec3 to_light = direction_of(photon);
    k.u_ws = stretched_direction(k.n_ws, to_light, frame_around(k.n_ws)[0]);
    k.t_ws = cross(k.n_ws, k.u_ws);
    k.radius = kernel_radius(photon);
    k.axes = vec3(light_shaping_scale(dot(k.n_ws, to_light), s_max), 1.0, s_n) * k.radius;
    k.irradiance = kernel_irradiance(unpacked_power(photon.power) * power_unit, kernel_area(k.axes.x, k.axes.y));
    return k;
}

/// Only from the side that the photon arrived on.
/// DEVIATION [Smal19 §4.3]: asked here too, as photons may be stored without being culled.
bool is_splatted(Photon photon) { return faces_viewer(photon.position_ws, normal_of(photon)); }
