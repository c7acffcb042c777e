// Packs the photons of one surface along the paths behind those of the surfaces before, in the paths' order.
layout(local_size_x = 64) in;

#include "methods/photon-mapping/records.glsl"

layout(std430) readonly buffer Landed { Photon landed[]; };
layout(std430) readonly buffer Flags { uint is_stored[]; };
layout(std430) readonly buffer Places { uint places[]; };
layout(std430) readonly buffer Bases { uint bases[]; };
layout(std430) writeonly buffer Records { Photon records[]; };

uniform uint first_item, end_item, surface_number, capacity;

void main() {
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index >= end_item || is_stored[index] == 0u) return;
    uint place = bases[surface_number] + places[index];
    if (place < capacity) records[place] = landed[index];
}
