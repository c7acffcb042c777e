// Marks the pixels where photons lie. Of several the same one wins on every device: the largest of numbers drawn
// from their index, so that no bounce hides another.
#include "methods/photon-mapping/records.glsl"
#include "methods/photon-mapping/splatting/splat_view.glsl"
#include "lib/random.glsl"

layout(local_size_x = 256) in;
layout(std430) readonly buffer Photons { Photon photons[]; };
layout(std430) readonly buffer Stored { uint stored; };
layout(r32ui) uniform uimage2D dots;
uniform sampler2D gbuffer_position;

uniform uint first_item, end_item;
uniform int dot_size;  // pixels

bool is_seen(vec3 position_ws) {
    if (!in_picture(position_ws)) return false;
    vec4 surface = texelFetch(gbuffer_position, ivec2(texel_at(position_ws)), 0);
    return surface.w == 0.0 || view_depth(position_ws) <= (1.0 + DEPTH_TOLERANCE) * view_depth(surface.xyz);
}

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i >= min(end_item, stored)) return;
    Photon photon = photons[i];
    if (!faces_viewer(photon.position_ws, normal_of(photon)) || !is_seen(photon.position_ws)) return;
    uint key = pcg(i) << 4u | bounce_of(photon);
    ivec2 corner = ivec2(texel_at(photon.position_ws)) - (dot_size - 1) / 2;
    for (int y = 0; y < dot_size; ++y)
        for (int x = 0; x < dot_size; ++x) imageAtomicMax(dots, corner + ivec2(x, y), key);
}
