// Hash table: how many cells the batch asks for, up to this chunk, so that nine in ten are filled.
layout(local_size_x = 1) in;
#include "passes/ldm/state.glsl"

layout(std430) buffer CellsRequested { uint cells_requested; };

uniform uint min_cells;

void main() {
    uint entries = requested + fragment_count;
    atomicMax(cells_requested, max(min_cells, entries + entries / 9u + 1u));
}
