// Fixed arrays, second step: one invocation sorts one texel's array, unless FIXED_PRESORTED is defined, and packs it.
// Arrays of up to FIXED_NETWORK layers are sorted in registers, longer ones by insertion: at most 256²/2 turns.
layout(local_size_x = 128) in;
#include "passes/ldm/chunk.glsl"
#include "passes/ldm/networks.glsl"

layout(std430) buffer LdmFixedChunk { uint nearness_of[]; };
layout(std430) writeonly buffer LdmFixedDepths { uint packed_depths[]; };

const uint TEXEL_WORDS = (FIXED_LAYERS + 1u) / 2u;

/// 65535 where there is none.
uint depth_of(uint first, uint layer) {
    return layer < FIXED_LAYERS ? 65535u - nearness_of[first + layer] : 65535u;
}

void sort_by_insertion(uint first) {
    for (uint i = 1u; i < FIXED_LAYERS; ++i) {
        uint nearness = nearness_of[first + i], k = i;
        while (k > 0u && nearness_of[first + k - 1u] < nearness) {
            nearness_of[first + k] = nearness_of[first + k - 1u];
            --k;
        }
        nearness_of[first + k] = nearness;
    }
}

void sort_in_registers(uint first, uint word) {
    uint v[FIXED_NETWORK];
    for (int i = 0; i < FIXED_NETWORK; ++i) v[i] = depth_of(first, uint(i));
#if FIXED_NETWORK == 32
    SORT_32(0)
#else
    SORT_16(0)
#endif
    for (int i = 0; i < FIXED_NETWORK / 2; ++i)
        if (uint(i) < TEXEL_WORDS) packed_depths[word + uint(i)] = v[2 * i] | v[2 * i + 1] << 16;
    for (uint i = uint(FIXED_NETWORK / 2); i < TEXEL_WORDS; ++i) packed_depths[word + i] = 0xffffffffu;
}

void main() {
    uint texel = gl_GlobalInvocationID.x;
    if (texel >= texel_count) return;
    uint first = texel * FIXED_LAYERS, word = (batch_texel + texel) * TEXEL_WORDS;
#ifndef FIXED_PRESORTED
    if (depth_of(first, uint(FIXED_NETWORK)) == 65535u) {
        sort_in_registers(first, word);
        return;
    }
    sort_by_insertion(first);
#endif
    for (uint i = 0u; i < TEXEL_WORDS; ++i)
        packed_depths[word + i] = depth_of(first, 2u * i) | depth_of(first, 2u * i + 1u) << 16;
}
