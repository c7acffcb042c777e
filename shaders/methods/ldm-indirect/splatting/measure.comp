// Counts the footprints that are not drawn as they are.
#include "methods/ldm-indirect/splatting/footprint.glsl"

layout(local_size_x = 256) in;
layout(std430) readonly buffer Photons { Photon photons[]; };
layout(std430) buffer Short { uint short_axes; };
layout(std430) buffer Long { uint long_axes; };
layout(std430) buffer Degenerate { uint degenerate; };
layout(std430) buffer Broken { uint broken; };

uniform uint first_item, end_item;

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i >= min(end_item, stored)) return;
    uint mended = footprint_of(photons[i]).mended;
    if ((mended & MENDED_SHORT) != 0u) atomicAdd(short_axes, 1u);
    if ((mended & MENDED_LONG) != 0u) atomicAdd(long_axes, 1u);
    if ((mended & MENDED_DEGENERATE) != 0u) atomicAdd(degenerate, 1u);
    if ((mended & NOT_FINITE) != 0u) atomicAdd(broken, 1u);
}
