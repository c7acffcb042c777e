// How many photons of each column each bin gets.
#include "passes/photons/bins.glsl"

layout(std430) buffer Counts { uint counts[]; };

void visit(uint slot, uint photon) { counts[slot] += 1u; }
