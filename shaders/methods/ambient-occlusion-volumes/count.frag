// Counts the volumes that cover a pixel, and those that its point lies in.
#define LIGHT 0
#include "methods/ambient-occlusion-volumes/triangle.glsl"
#include "methods/ambient-occlusion-volumes/volume.glsl"
#include "passes/raytracing/ray_offset.glsl"
#include "passes/bounce/receiver.glsl"

uniform float reach;
uniform int both_sides;

layout(location = 0) flat in uint occluder;
layout(location = 0) out float drawn;
layout(location = 1) out float within;

void main() {
    drawn = 1.0;
    within = 0.0;
    Receiver receiver = receiver_at(ivec2(gl_FragCoord.xy));
    if (!receiver.exists) return;
    mat3 corners = corners_ws(occluder);
    vec3 x = offset_origin(receiver.position, receiver.geometric_normal);
    if (is_within(volume_of(corners[0], corners[1], corners[2]), x, reach, both_sides != 0)) within = 1.0;
}
