// What adding up needs of each photon, computed once and not again for each tile that it lies in.
#include "methods/ldm-indirect/splatting/packed_kernel.glsl"

layout(local_size_x = 64) in;
layout(std430) readonly buffer Photons { Photon photons[]; };
layout(std430) writeonly buffer Kernels { PackedKernel kernels[]; };
layout(std430) readonly buffer Count { uint photon_count; };
layout(std430) buffer KernelCount { uint kernel_count; };

uniform uint first_item, end_item, capacity;

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i == 0u) kernel_count = photon_count;
    if (i >= min(end_item, min(stored, capacity))) return;
    Footprint f = footprint_of(photons[i]);
    if (f.counts) kernels[i] = packed_kernel(kernel_of(f));
}
