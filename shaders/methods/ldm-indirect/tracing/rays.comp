// Rays along the maps' directions from a part of the primary photons, for another tracer than the maps.
layout(local_size_x = 64) in;
#include "passes/ldm/frames.glsl"
#include "passes/raytracing/ray_offset.glsl"
#include "passes/raytracing/rays.glsl"
#include "methods/ldm-indirect/tracing/primary.glsl"

layout(std430) readonly buffer Primaries { Primary primaries[]; };
/// Of each primary photon one for each of the batch's maps; none where there is no photon.
layout(std430) writeonly buffer Rays { Ray rays[]; };

uniform uint first_item, end_item;
uniform uint first_primary, end_primary, first_frame, batch_maps;
uniform float ray_start;  // m, from the surface

Ray ray_of(Primary p, vec3 v) {
    vec3 direction = dot(p.shading_ws, v) > 0.0 ? v : -v;
    if (!sends_on(p) || dot(p.normal_ws, direction) <= 0.0) return no_ray();
    return Ray(offset_origin(p.position_ws, p.normal_ws) + ray_start * direction, RAY_INFINITY, direction, 0.0);
}

void main() {
    uint item = first_item + gl_GlobalInvocationID.x;
    if (item >= end_item) return;
    uint index = first_primary + item / batch_maps;
    vec3 v = ldm_frames[first_frame + item % batch_maps].direction.xyz;
    rays[item] = index < end_primary ? ray_of(primaries[index], v) : no_ray();
}
