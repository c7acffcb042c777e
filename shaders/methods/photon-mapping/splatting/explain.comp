// Gathers one texel over all photons: what a splat adds up, found the other way round.
#include "lib/floats.glsl"
#include "methods/photon-mapping/splatting/added.glsl"

layout(local_size_x = 256) in;

/// As fields of "splat.explain.photons".
// C++: ir::methods::photon_mapping::FoundPhoton
struct Found {
    float centre[3], axis_u[3], axis_v[3], axis_w[3], contribution[3], power[3];
    uint bounce, light;
    float distance, radius;
    uint photon, path;
};
layout(std430) writeonly buffer FoundPhotons { Found found[]; };
/// As fields of "splat.explain.sum"; the host adds up, in double precision and in one order.
layout(std430) buffer PixelSum {
    uint texel_x, texel_y, found_count;
    float gathered[3], texel_value[3], difference[3];
};
layout(std430) buffer PhotonCount { uint photon_count; };
layout(std430) buffer SumCount { uint sum_count; };

uniform sampler2D irradiance;

uniform uint first_item, end_item;
uniform ivec2 picked_texel;  // negative: none

void write(uint place, uint i, Photon photon, Kernel k, SeenSurface seen) {
    found[place].centre = floats(k.centre_ws);
    found[place].axis_u = floats(k.axes.x * k.u_ws);
    found[place].axis_v = floats(k.axes.y * k.t_ws);
    found[place].axis_w = floats(k.axes.z * k.n_ws);
    found[place].contribution = floats(added_by(k, direction_of(photon), seen).irradiance);
    found[place].power = floats(unpacked_power(photon.power) * power_unit);
    found[place].bounce = bounce_of(photon);
    found[place].light = light_of(photon);
    found[place].distance = distance(k.centre_ws, seen.origin + seen.depth * seen.direction);
    found[place].radius = k.radius;
    found[place].photon = i;
    found[place].path = 0u;  // the host's
}

void main() {
    if (picked_texel.x < 0 || isinf(texelFetch(depths, picked_texel, 0).x)) return;
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i == 0u) {
        atomicAdd(sum_count, 1u);
        texel_value = floats(texelFetch(irradiance, picked_texel, 0).rgb);
    }
    if (i >= min(end_item, stored)) return;
    Photon photon = photons[i];
    if (!is_splatted(photon)) return;
    Kernel k = kernel_of(photon);
    SeenSurface seen = surface_seen_at(picked_texel);
    if (!covers(k.centre_ws, k.n_ws, k.u_ws, k.t_ws, k.axes, direction_of(photon), seen)) return;
    atomicAdd(photon_count, 1u);
    uint place = atomicAdd(found_count, 1u);
    if (place < uint(found.length())) write(place, i, photon, k, seen);
}
