// The pixel's own ray against the triangle; what is nearest along the ray wins the depth test. [Nalbach15 §3.2]
#define LIGHT 0
#include "methods/ambient-occlusion-volumes/triangle.glsl"
#include "methods/ambient-occlusion-volumes/ray.glsl"
#include "passes/raytracing/ray_offset.glsl"
#include "passes/bounce/receiver.glsl"

uniform sampler2DArray directions;
uniform int layer;
uniform float reach;

layout(location = 0) flat in uint occluder;
layout(location = 0) out uint winner;
layout(location = 1) out float distance_ws;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 direction = texelFetch(directions, ivec3(pixel, layer), 0);
    if (direction.w == 0.0) discard;
    Receiver receiver = receiver_at(pixel);
    float t = hit_distance(occluder, corners_ws(occluder), offset_origin(receiver.position, receiver.geometric_normal),
                           direction.xyz, reach);
    if (t < 0.0) discard;
    winner = occluder + 1u;
    distance_ws = t;
    gl_FragDepth = t * t / (reach * reach);  // z = |x − y|² / r²
}
