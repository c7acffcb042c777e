// Hash table: one invocation puts one fragment in, and in its place what it displaces.
layout(local_size_x = 64) in;
#include "passes/ldm/chunk.glsl"
#include "passes/ldm/fragments.glsl"
#include "passes/ldm/hash_cells.glsl"
#include "passes/ldm/list_index.glsl"

layout(std430) buffer MaxAge { uint max_age; };
layout(std430) coherent buffer LdmAges { uint ages[]; };
layout(std430) coherent buffer LdmCells { uint cells[]; };

/// A cell keeps the larger of what it holds and what comes, which hands on the smaller one at its texel's next age.
/// [Lefebvre14 §3.4] Whatever leaves a cell or passes it is below what stays, and of one texel the age is the same
/// there: depths rise with age. False if no cell was found.
bool insert(uint texel, uint nearness) {
    uint size = uint(cells.length()), age = 1u, oldest = 0u;
    bool placed = false;
    for (uint turn = 0u; turn < MAX_LAYERS && !placed && age <= MAX_LAYERS; ++turn) {
        uint cell = hash_cell(texel, age, size), entry = age << 16 | nearness;
        uint seen = cells[cell];  // cells only grow: what is too large now stays so
        if (seen < entry) seen = atomicMax(cells[cell], entry);
        if (seen < entry) {
            atomicMax(ages[texel], age);
            oldest = max(oldest, age);
            placed = seen == 0u;
            nearness = seen & 0xffffu;
            age = seen >> 16;
            texel = hash_texel(cell, age, size);
        }
        ++age;
    }
    atomicMax(max_age, oldest);
    return placed;
}

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length()))) return;
    if (requested + index >= uint(cells.length()) - uint(cells.length()) / 10u) return;  // the table will grow
    LdmFragment fragment = fragments[index];
    if (insert(batch_texel + fragment.texel, 65535u - (fragment.arrival_depth & 0xffffu))) return;
    atomicAdd(dropped, 1u);
    atomicAdd(chunk_total, 0xffffffffu);
}
