// One surfel against the ray of one pixel, for one sample on one level. [Nalbach15 §3.2, §4.2]
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/places.glsl"
#include "methods/deep-screen-space/splatting/visible_hit.glsl"
#include "methods/deep-screen-space/splatting/accepted.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };

uniform usampler2DArray layout_texture;
uniform sampler2DArray shuffled_positions;  // shuffled
uniform sampler2DArray directions;
uniform sampler2D gbuffer_geometric_normal;

uniform int level, sample_index;

layout(location = 0) flat in uint surfel_index;
layout(location = 0) out uint winner;

/// Tests in the order of what they cost and how many splats they end.
void main() {
    ivec3 place = ivec3(gl_FragCoord.xy, level);
    vec4 x = texelFetch(shuffled_positions, place, 0);
    if (x.w == 0.0) discard;
    Surfel surfel = surfels[surfel_index];
    SplatLevel l = splat_level(level, surfel);
    int shell = splat_shell(l, x.xyz, surfel.centre_ws);
    if (shell < 0) discard;
    ivec2 pixel = unpacked_place(texelFetch(layout_texture, place, 0).x);
    vec4 direction = texelFetch(directions, ivec3(pixel, sample_index), 0);
    if (direction == vec4(0)) discard;
    SplatHit hit = splat_hit(l, shell, x.xyz, direction.xyz, surfel.centre_ws, surfel.normal_ws, surfel.radius);
    if (hit.outcome != SPLAT_HIT) discard;
    vec3 normal_ws = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    if (!splat_is_accepted(surfel, hit, pixel, sample_index, x.xyz, direction.xyz, normal_ws)) discard;
    winner = 1u + surfel_index;
    gl_FragDepth = hit.z;
}
