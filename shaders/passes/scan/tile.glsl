// Sums within a tile of 2048 words by a work group of 256 invocations.

// C++: ir::passes::*
const uint SCAN_GROUP = 256u, SCAN_TILE = 2048u;
const uint SCAN_SHARE = SCAN_TILE / SCAN_GROUP;

shared uint tile_words[SCAN_TILE + SCAN_TILE / 32u];  // a word of padding per 32: no bank conflicts
shared uint tile_sums[SCAN_GROUP];

uint padded(uint word) { return word + word / 32u; }

/// Sums before and within each invocation's share of the tile; all invocations call it together.
/// [Hillis86 fig. 2]
uint scanned_group(uint sum, out uint total) {
    uint me = gl_LocalInvocationID.x;
    tile_sums[me] = sum;
    barrier();
    for (uint step = 1u; step < SCAN_GROUP; step *= 2u) {
        uint before = me >= step ? tile_sums[me - step] : 0u;
        barrier();
        tile_sums[me] += before;
        barrier();
    }
    total = tile_sums[SCAN_GROUP - 1u];
    return tile_sums[me] - sum;
}

/// Replaces the words of the tile by the sums before them, plus `base`; returns the tile's sum. The words must
/// have been written before a barrier; the result may be read after another one.
uint scan_tile(uint base) {
    uint first = gl_LocalInvocationID.x * SCAN_SHARE, sum = 0u, total;
    for (uint i = 0u; i < SCAN_SHARE; ++i) sum += tile_words[padded(first + i)];
    uint before = base + scanned_group(sum, total);
    for (uint i = 0u; i < SCAN_SHARE; ++i) {
        uint word = tile_words[padded(first + i)];
        tile_words[padded(first + i)] = before;
        before += word;
    }
    return total;
}
