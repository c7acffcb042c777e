// The random numbers of passes::PathSampler (renderers/passes/sampling/point_sequence.h), bit for bit. 64-bit words
// are uvec2, the lower half first.

uvec2 sum64(uvec2 a, uvec2 b) {
    uint low = a.x + b.x;
    return uvec2(low, a.y + b.y + (low < a.x ? 1u : 0u));
}
/// Not by umulExtended(), which Mesa 22 gets wrong where both factors are constant.
uvec2 product64(uvec2 a, uvec2 b) {
    uint low = (a.x & 0xffffu) * (b.x & 0xffffu);
    uint middle = (a.x >> 16) * (b.x & 0xffffu) + (low >> 16);
    uint other = (a.x & 0xffffu) * (b.x >> 16) + (middle & 0xffffu);
    uint high = (a.x >> 16) * (b.x >> 16) + (middle >> 16) + (other >> 16);
    return uvec2(a.x * b.x, high + a.x * b.y + a.y * b.x);
}
/// x ^ x >> bits, bits from 1 to 31.
uvec2 folded64(uvec2 x, int bits) { return x ^ uvec2(x.x >> bits | x.y << (32 - bits), x.y >> bits); }

/// A bijection whose results look independent.  [Steele14, the finaliser of SplitMix]
uvec2 mixed(uvec2 x) {
    x = sum64(x, uvec2(0x7f4a7c15u, 0x9e3779b9u));
    x = product64(folded64(x, 30), uvec2(0x1ce4e5b9u, 0xbf58476du));
    x = product64(folded64(x, 27), uvec2(0x133111ebu, 0x94d049bbu));
    return folded64(x, 31);
}

/// Seed of everything random in one pixel.
uvec2 pixel_key(uvec2 seed, uvec2 pixel) { return mixed(mixed(seed) ^ pixel); }

/// Nested permutation of reversed bits.  [Laine11 §3.3]
uint scrambled(uint x, uint seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

/// Second dimension of Sobol's sequence with its bits reversed.
uint reversed_sobol_second(uint index) {
    index ^= index >> 16;
    index ^= (index >> 8) & 0x00ff00ffu;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 2) & 0x33333333u;
    return index ^ ((index >> 1) & 0x55555555u);
}

/// Point `index` of the sequence that `key` and a dimension name, in [0, 1)².  [Burley20 §5]
vec2 path_pair(uvec2 key, uint index, uint dimension) {
    uvec2 seeds = mixed(key ^ mixed(uvec2(dimension, 0)));
    uint order = mixed(seeds).x;
    uint shuffled = bitfieldReverse(scrambled(bitfieldReverse(index), order));
    uvec2 bits = uvec2(bitfieldReverse(scrambled(shuffled, seeds.x)),
                       bitfieldReverse(scrambled(reversed_sobol_second(shuffled), seeds.y)));
    return vec2(bits >> 8u) * (1.0 / 16777216.0);
}
