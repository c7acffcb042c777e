// Sums each row of the table over blocks of photons, in a fixed order.
layout(local_size_x = 64) in;
#include "lib/floats.glsl"
#include "methods/ldm-indirect/tracing/primary.glsl"
#include "methods/ldm-indirect/tracing/energy.glsl"

layout(std430) readonly buffer Primaries { Primary primaries[]; };
layout(std430) readonly buffer AllShares { Shares all_shares[]; };
layout(std430) writeonly buffer Blocks { Row blocks[]; };
#ifdef DIRECT
layout(std430) readonly buffer Fates { uint fates[]; };
#endif

uniform uint first_item, end_item;  // rows of blocks
uniform uint primary_count, block_size, direct_count;
uniform bool splits;

struct Entry {
    vec3 flux;
    uint photons;
};

Entry entry(bool is_there, vec3 flux) { return Entry(is_there ? flux : vec3(0), is_there ? 1u : 0u); }

Entry entry_of(uint index, uint row) {
    Primary p = primaries[index];
    bool arrives = p.fate == PRIMARY_SPLITS;
    if (row == ROW_EMITTED) return entry(p.emitted != vec3(0), p.emitted * (1.0 + p.missed));
    if (row == ROW_NOTHING && p.fate != PRIMARY_NOTHING) return Entry(p.emitted * p.missed, 0u);
    if (row == ROW_NOTHING) return entry(p.emitted != vec3(0), p.emitted);
    if (row == ROW_RANGE)
        return entry(p.fate != PRIMARY_NOTHING && p.reached < 1.0, p.emitted * (1.0 - p.reached));
    if (row == ROW_DEGENERATE) return entry(p.fate == PRIMARY_DEGENERATE, arrived_flux(p));
    if (row == ROW_ABSORBED)
        return entry(arrives && p.reflectance != vec3(1), arrived_flux(p) * (1.0 - p.reflectance));
    if (row == ROW_UNSPLIT) return entry(arrives && !splits, reflected_flux(p));
    if (row < ROW_DIRECT) {
        uint cause = row - ROW_INDIRECT;
        if (!arrives || !splits) return Entry(vec3(0), 0u);
        return Entry(reflected_flux(p) * all_shares[index].part[cause], all_shares[index].photons[cause]);
    }
    if (index >= direct_count) return Entry(vec3(0), 0u);
#ifdef DIRECT
    return entry(fates[index] == row - ROW_DIRECT, arrived_flux(p));
#else
    return Entry(vec3(0), 0u);
#endif
}

void main() {
    uint item = first_item + gl_GlobalInvocationID.x;
    if (item >= end_item) return;
    uint block = item / ENERGY_ROWS, row = item % ENERGY_ROWS;
    Entry sum = Entry(vec3(0), 0u);
    for (uint i = block * block_size; i < min((block + 1u) * block_size, primary_count); ++i) {
        Entry one = entry_of(i, row);
        sum.flux += one.flux;
        sum.photons += one.photons;
    }
    blocks[item] = Row(row, row >= ROW_DIRECT ? 2u : row >= ROW_INDIRECT ? 1u : 0u, sum.photons,
                       floats(sum.flux));
}
