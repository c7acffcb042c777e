// The first hits of the rays of a buffer. One invocation: one ray.
layout(local_size_x = 64) in;
#include "lib/floats.glsl"
#include "passes/raytracing/bvh.glsl"

layout(std430) readonly buffer Rays { Ray rays[]; };
layout(std430) writeonly buffer Hits { RayHit hits[]; };
layout(std430) buffer Unfinished { uint unfinished; };

uniform uint first_item, end_item;

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i >= end_item) return;
    Ray ray = rays[i];
    RayHit hit = no_hit();
    // The sum is finite where both are.
    if (ray.far > 0.0 && is_finite(ray.origin_ws + ray.direction_ws))
        if (!find_first_hit(ray, hit)) atomicAdd(unfinished, 1u);
    hits[i] = hit;
}
