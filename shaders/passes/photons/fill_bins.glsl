// Writes the bins' lists. What was the first place of a column's photons in a bin is the end of them afterwards.
#include "passes/photons/bins.glsl"

layout(std430) buffer Places { uint places[]; };
layout(std430) writeonly buffer Lists { uint lists[]; };

void visit(uint slot, uint photon) {
    uint place = places[slot];
    places[slot] = place + 1u;
    if (place < uint(lists.length())) lists[place] = photon;
}
