// Gathers one pixel over all photons: what splatting adds up, found the other way round and by M as printed.
#include "lib/floats.glsl"
#include "methods/ldm-indirect/seen.glsl"
#include "methods/ldm-indirect/splatting/kernel.glsl"
#ifdef CLIPPED
#include "methods/ldm-indirect/splatting/clipping.glsl"
#endif

layout(local_size_x = 256) in;

layout(std430) readonly buffer Photons { Photon photons[]; };

/// As fields of "indirect.explain.photons".
// C++: ir::methods::ldm_indirect::FoundPhoton
struct Found {
    float centre[3], axis_u[3], axis_v[3], contribution[3], flux[3];
    uint map;
    int side;
    uint light, source;
    float path_length, distance;
    uint photon;
};
layout(std430) writeonly buffer FoundPhotons { Found found[]; };
/// As fields of "indirect.explain.sum"; the host adds up, in double precision and in one order.
layout(std430) buffer PixelSum {
    uint pixel_x, pixel_y, found_count;
    float gathered[3], direct[3], pixel_value[3], difference[3];
};
layout(std430) buffer PhotonCount { uint photon_count; };
layout(std430) buffer SumCount { uint sum_count; };

uniform sampler2D irradiance_image;

uniform uint first_item, end_item;
uniform ivec2 picked_pixel;  // negative: none

/// ‖M (x - x_p)‖ with M as printed, and a = a' √|D_u x × D_v x|.  [Aalund15 eq. 7]
float filter_length(Footprint f, vec3 x) {
    if (f.distance > 0.0) return sqrt(squared_length(kernel_of(f), x));
    vec3 d_u = 2.0 * f.p_ws, d_v = 2.0 * f.q_ws, n = f.n_ws, d = x - f.centre_ws;
    float a = topological_bias * sqrt(length(cross(d_u, d_v)));
    float scale = 2.0 / dot(d_u, cross(d_v, n));
    return length(scale * vec3(dot(cross(d_v, n), d), dot(cross(n, d_u), d), a * dot(n, d)));
}

/// [Aalund15 eqs. 4-6]
vec3 contribution_of(Photon photon, Footprint f, vec3 x, float facing) {
    float area = PI / 4.0 * length(cross(2.0 * f.p_ws, 2.0 * f.q_ws)), l = filter_length(f, x);
    float kernel = l < 1.0 ? 3.0 / PI * (1.0 - l * l) * (1.0 - l * l) : 0.0;
    return photon.flux / (area * part_on_surface(photon)) * PI * kernel * turned(facing, per_cosine(f));
}

void write(uint place, uint i, Photon photon, Footprint f, vec3 x, float facing) {
    bool is_direct = (photon.leg & LEG_DIRECT) != 0u;
    found[place].centre = floats(f.centre_ws);
    found[place].axis_u = floats(f.p_ws);
    found[place].axis_v = floats(f.q_ws);
    found[place].contribution = floats(contribution_of(photon, f, x, facing));
    found[place].flux = floats(photon.flux);
    found[place].map = is_direct ? LEG_MAP : photon.leg & LEG_MAP;
    found[place].side = is_direct ? 0 : (photon.leg & LEG_ALONG) != 0u ? 1 : -1;
    found[place].light = photon.leg >> LEG_LIGHT_SHIFT;
    found[place].source = photon.source;
    found[place].path_length = photon.path_length;
    found[place].distance = distance(f.centre_ws, x);
    found[place].photon = i;
}

void main() {
    if (picked_pixel.x < 0) return;
    vec3 normal_ws = texelFetch(gbuffer_geometric_normal, picked_pixel, 0).xyz;
    if (normal_ws == vec3(0)) return;
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i == 0u) {
        atomicAdd(sum_count, 1u);
        pixel_x = uint(picked_pixel.x);
        pixel_y = uint(picked_pixel.y);
        pixel_value = floats(texelFetch(irradiance_image, picked_pixel, 0).rgb);
    }
    if (i >= min(end_item, stored)) return;
    Photon photon = photons[i];
    Footprint f = footprint_of(photon);
    vec3 x = texelFetch(gbuffer_position, picked_pixel, 0).xyz;
    float facing = dot(normal_ws, f.to_source_ws);
    if (!f.counts || filter_length(f, x) >= 1.0 || facing <= 0.0) return;
#ifdef CLIPPED
    if (!is_lit(kernel_of(f), picked_pixel, textureSize(gbuffer_position, 0), x)) return;
#endif
    atomicAdd(photon_count, 1u);
    uint place = atomicAdd(found_count, 1u);
    if (place < uint(found.length())) write(place, i, photon, f, x, facing);
}
