// Photons by tile of the picture; sums of integers do not depend on their order.  [Smal19 §6.1.1]
#include "methods/photon-mapping/records.glsl"
#include "methods/photon-mapping/splatting/splat_view.glsl"

layout(local_size_x = 256) in;
layout(std430) readonly buffer Photons { Photon photons[]; };
layout(std430) readonly buffer Stored { uint stored; };
layout(r32ui) uniform uimage2D tiles;

uniform uint first_item, end_item;
uniform int tile_size;

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i >= min(end_item, stored)) return;
    Photon photon = photons[i];
    if (!in_picture(photon.position_ws) || !faces_viewer(photon.position_ws, normal_of(photon))) return;
    imageAtomicAdd(tiles, ivec2(texel_at(photon.position_ws) / float(tile_size)), 1u);
}
