// Cosine-weighted form factor of the triangle times its fall-off, to be summed over all triangles. [McGuire10]
#define LIGHT 0
#include "methods/ambient-occlusion-volumes/triangle.glsl"
#include "methods/ambient-occlusion-volumes/occlusion.glsl"
#include "passes/bounce/receiver.glsl"

layout(std430) readonly buffer Occluders { Occluder occluders[]; };

layout(location = 0) flat in uint occluder;
layout(location = 0) out float occlusion;

void main() {
    Receiver receiver = receiver_at(ivec2(gl_FragCoord.xy));
    if (!receiver.exists) discard;
    vec3 x = offset_origin(receiver.position, receiver.geometric_normal);
    mat3 corners = corners_ws(occluder);
    Volume v = volume_of(corners[0], corners[1], corners[2]);
    if (!is_within(v, x, reach, params.sides == SIDES_BOTH)) discard;
    occlusion = occluders[occluder].coverage * falloff_weight(v, x) * form_factor_of(v, x, receiver.normal);
}
