// Sums the kernels of a bin's photons over its texels. A work group makes kernels of photons side by side, once for all
// of its texels.  [Smal19 §6.3]
#include "methods/photon-mapping/splatting/added.glsl"
#include "passes/photons/binned.glsl"

const uint KERNELS_AT_ONCE = 128u;

layout(local_size_x = GATHERED_TILE, local_size_y = GATHERED_TILE) in;
layout(SUMS) uniform image2D sums;
layout(DIRECTIONS) uniform image2D directions;

shared Kernel kernels[KERNELS_AT_ONCE];
shared vec3 to_light_ws[KERNELS_AT_ONCE];

void main() {
    uvec2 corner = corner_of_tile(), entries = entries_of(corner);
    if (entries.x >= entries.y) return;
    ivec2 texel = ivec2(corner + gl_LocalInvocationID.xy);
    bool is_there = all(lessThan(texel, imageSize(sums)));
    SeenSurface seen = surface_seen_at(is_there ? texel : ivec2(0));
    vec4 sum = is_there ? imageLoad(sums, texel) : vec4(0);
    vec2 direction = is_there ? imageLoad(directions, texel).xy : vec2(0);
    for (uint first = entries.x; first < entries.y; first += KERNELS_AT_ONCE) {
        uint own = first + gl_LocalInvocationIndex;
        barrier();
        if (gl_LocalInvocationIndex < KERNELS_AT_ONCE && own < entries.y) {
            Photon photon = photons[lists[own]];
            kernels[gl_LocalInvocationIndex] = kernel_of(photon);
            to_light_ws[gl_LocalInvocationIndex] = direction_of(photon);
        }
        barrier();
        uint end = min(KERNELS_AT_ONCE, entries.y - first);
        for (uint i = 0u; i < end; ++i) {
            Kernel k = kernels[i];
            if (!covers(k.centre_ws, k.n_ws, k.u_ws, k.t_ws, k.axes, to_light_ws[i], seen)) continue;
            Added added = added_by(k, to_light_ws[i], seen);
            sum += vec4(added.irradiance, added.direction.x);
            direction += added.direction.yz;
        }
    }
    if (!is_there) return;
    imageStore(sums, texel, sum);
    imageStore(directions, texel, vec4(direction, 0, 0));
}
