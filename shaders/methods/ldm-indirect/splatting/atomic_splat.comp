// A work group for each stored photon.
#include "methods/ldm-indirect/splatting/atomic_add.glsl"

// C++: ir::methods::ldm_indirect::splat_lanes
const uint SPLAT_LANES = 32u;

layout(local_size_x = SPLAT_LANES) in;
layout(std430) readonly buffer Photons { Photon photons[]; };

uniform uint first_item, end_item;
uniform uint first_pixel, end_pixel;  // of a rectangle, so that no loop is too long

void main() {
    uint i = first_item + gl_WorkGroupID.x;
    if (i < min(end_item, stored))
        splat_atomically(footprint_of(photons[i]), first_pixel + gl_LocalInvocationID.x, SPLAT_LANES, end_pixel);
}
