// What is seen along each direction of ambient occlusion: 1 where nothing is met.
#define LIGHT 0
#include "passes/bounce/receiver.glsl"
#include "passes/bounce/tiles.glsl"

uniform sampler2DArray directions;
uniform sampler2DArray distances;
layout(r32f) uniform writeonly image2DArray incoming;

uniform float max_distance;  // m; 0: no limit

/// V of the first hit at this distance. [Aalund15 §3.3]
float visibility(float distance_ws) {
    if (distance_ws < 0.0) return 1.0;
    if (max_distance == 0.0) return 0.0;
    if (distance_ws >= max_distance) return 1.0;
#if SMOOTH
    float part = distance_ws / max_distance;
    return part * part;
#else
    return 0.0;
#endif
}

void main() {
    ivec2 pixel = tile_pixel();
    ivec3 size = imageSize(incoming);
    if (any(greaterThanEqual(pixel, size.xy))) return;
    vec3 geometric_normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    for (int i = 0; i < size.z; ++i) {
        vec4 direction = texelFetch(directions, ivec3(pixel, i), 0);
        float v = visibility(texelFetch(distances, ivec3(pixel, i), 0).x);
        if (direction.w > 0.0 && dot(direction.xyz, geometric_normal) <= 0.0) v = 0.0;
        imageStore(incoming, ivec3(pixel, i), vec4(v));
    }
}
