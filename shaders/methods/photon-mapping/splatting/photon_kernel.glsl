// The kernels of the stored photons under the frame's settings.
#include "methods/photon-mapping/records.glsl"
#include "methods/photon-mapping/splatting/depths.glsl"
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

/// Photons in the tile of a place; at least the one that is splatted, which may be outside the picture.
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
    float facing = facing_part(photon.position_ws, normal_of(photon));
    float tile = surface_area(tile_area(depth, c_tile, perspective), facing);
    float r = density_radius(tile, photons_of_tile(photon.position_ws));
    float s_l = ray_length_scale(photon.ray_length, l_max, min_ray_length_scale);
    float texel = sqrt(surface_area(tile_area(depth, c_texel, perspective), facing));
    return shrinking * max(s_l * density_scale(r, r_min, r_max, n_tile), min_radius_texels * texel);
}

#ifdef EDGE_PROBES
/// Places of a kernel that are looked at.
// C++: ir::methods::photon_mapping::probe_count
const int PROBES = 8;
/// Of them so many count at least: without a bound single photons on thin things would be eight times as bright.
// C++: ir::methods::photon_mapping::least_found
const int LEAST_FOUND = 3;
/// Between them, radians.
// C++: ir::methods::photon_mapping::golden_angle
const float GOLDEN_ANGLE = 2.3999632;

/// Whether the kernel meets something at a place of its plane, as far as the picture tells: not where what is seen
/// there lies behind it, nor where a surface before it cuts it. What is farther before it may hide a surface.
bool finds_surface(Kernel k, vec3 place_ws, float half_thickness) {
    if (!in_picture(place_ws)) return true;
    ivec2 texel = ivec2(texel_at(place_ws));
    if (isinf(texelFetch(depths, texel, 0).x)) return false;
    vec3 offset = surface_at(texel) - k.centre_ws;
    float height = dot(k.n_ws, offset);
    if (abs(height) <= half_thickness) return true;
    return height > 0.0 && length(offset) > max(k.axes.x, max(k.axes.y, k.axes.z));
}

/// The part of the kernel that has something to light, by places that stand for equal areas.
float covered_part(Kernel k) {
    int found = 0;
    for (int i = 0; i < PROBES; ++i) {
        float squared = (float(i) + 0.5) / float(PROBES), angle = GOLDEN_ANGLE * float(i);
        vec2 place = sqrt(squared) * vec2(cos(angle), sin(angle)) * k.axes.xy;
        vec3 place_ws = k.centre_ws + place.x * k.u_ws + place.y * k.t_ws;
        found += int(finds_surface(k, place_ws, sqrt(1.0 - squared) * k.axes.z));
    }
    return float(max(found, LEAST_FOUND)) / float(PROBES);
}
#endif

/// [Smal19 §6.1.2]
Kernel kernel_of(Photon photon) {
    Kernel k;
    k.centre_ws = photon.position_ws;
    k.n_ws = normal_of(photon);
    vec3 to_light = direction_of(photon);
    k.u_ws = stretched_direction(k.n_ws, to_light);
    k.t_ws = cross(k.n_ws, k.u_ws);
    k.radius = kernel_radius(photon);
    k.axes = vec3(light_shaping_scale(dot(k.n_ws, to_light), s_max), 1.0, s_n) * k.radius;
    float area = kernel_area(k.axes.x, k.axes.y);
#ifdef EDGE_PROBES
    area *= covered_part(k);
#endif
    k.irradiance = kernel_irradiance(unpacked_power(photon.power) * power_unit, area);
    return k;
}

/// Only from the side that the photon arrived on.
/// DEVIATION [Smal19 §4.3]: tested here too, as photons may be stored without being culled.
bool is_splatted(Photon photon) { return faces_viewer(photon.position_ws, normal_of(photon)); }
