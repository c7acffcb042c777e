// Arrays, fifth step: one invocation sorts one texel's depths and packs them. Up to seven or eight are sorted
// in registers by a network, more by insertion; the deepest are left to array_sort_deep.comp.
layout(local_size_x = 128) in;
#include "passes/ldm/array_builder.glsl"

/// Insertion takes up to n²/2 turns, and drivers may stop loops after 65,535.
const uint MOST_INSERTED = 192u;

void order(inout uint a, inout uint b) {
    uint least = min(a, b);
    b = max(a, b);
    a = least;
}

/// Stores two depths in a word of which the texel owns halves begin … end - 1.
void store_pair(uint word, uint low, uint high, uint begin, uint end) {
    bool owns_low = 2u * word >= begin, owns_high = 2u * word + 1u < end;
    if (2u * word >= end) return;
    if (owns_low && owns_high)
        depths[word] = low | high << 16;
    else if (owns_low)
        store_half(2u * word, low);
    else if (owns_high)
        store_half(2u * word + 1u, high);
}

void main() {
    uint texel = gl_GlobalInvocationID.x;
    if (texel >= row_count * resolution) return;
    uint source = counts[texel], count = counts[texel + 1u] - source;
    uint begin = stored + source, end = begin + count;
    if (count == 0u || end > 2u * uint(depths.length()) || source + count > uint(unsorted.length())) return;
    if (count > MOST_INSERTED) {
        deep_groups[0] = fragment_groups[0];
        deep_groups[1] = fragment_groups[1];
        return;
    }
    uint word = begin >> 1, odd = begin & 1u;
    if (count + odd <= 4u) {
        // An odd begin is filled up with a depth that sorts before all.
        uint a = 0u, b = 65535u, c = 65535u, d = 65535u;
        uint from = source - odd;
        if (odd == 0u) a = unsorted[from];
        if (count + odd > 1u) b = unsorted[from + 1u];
        if (count + odd > 2u) c = unsorted[from + 2u];
        if (count + odd > 3u) d = unsorted[from + 3u];
        order(a, b), order(c, d), order(a, c), order(b, d), order(b, c);
        store_pair(word, a, b, begin, end);
        store_pair(word + 1u, c, d, begin, end);
        return;
    }
    if (count + odd <= 8u) {
        uint a = 0u, b, c, d, e, f = 65535u, g = 65535u, h = 65535u;
        uint from = source - odd;
        if (odd == 0u) a = unsorted[from];
        b = unsorted[from + 1u];
        c = unsorted[from + 2u];
        d = unsorted[from + 3u];
        e = unsorted[from + 4u];
        if (count + odd > 5u) f = unsorted[from + 5u];
        if (count + odd > 6u) g = unsorted[from + 6u];
        if (count + odd > 7u) h = unsorted[from + 7u];
        // Batcher's odd-even merge sort of eight: 19 comparators. [Batcher68]
        order(a, b), order(c, d), order(e, f), order(g, h);
        order(a, c), order(b, d), order(e, g), order(f, h);
        order(b, c), order(f, g);
        order(a, e), order(b, f), order(c, g), order(d, h);
        order(c, e), order(d, f);
        order(b, c), order(d, e), order(f, g);
        store_pair(word, a, b, begin, end);
        store_pair(word + 1u, c, d, begin, end);
        store_pair(word + 2u, e, f, begin, end);
        store_pair(word + 3u, g, h, begin, end);
        return;
    }
    for (uint i = 1u; i < count; ++i) {
        uint depth = unsorted[source + i], k = i;
        while (k > 0u) {
            uint other = unsorted[source + k - 1u];
            if (other <= depth) break;
            unsorted[source + k] = other;
            --k;
        }
        unsorted[source + k] = depth;
    }
    if (odd != 0u) store_half(begin, unsorted[source]);
    uint i = odd;
    for (; i + 1u < count; i += 2u)
        depths[(begin + i) >> 1] = unsorted[source + i] | unsorted[source + i + 1u] << 16;
    if (i < count) store_half(begin + i, unsorted[source + i]);
}
