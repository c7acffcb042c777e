// Outermost depths: one invocation raises those of one fragment's texel, where it reaches beyond them.
layout(local_size_x = 64) in;
#include "passes/ldm/chunk.glsl"
#include "passes/ldm/fragments.glsl"
#include "passes/ldm/list_index.glsl"

layout(std430) coherent buffer LdmOutermost { uint outermost[]; };
layout(std430) buffer Between { uint between; };

shared uint left_out;  // fragments of the group that add no depth, or displace one

uint raised(uint word, uint depth) {
    return max(word >> 16, depth) << 16 | max(word & 0xffffu, 65535u - depth);
}
/// How many depths a word holds.
uint held(uint word) {
    return word == 0u ? 0u : (word >> 16) + (word & 0xffffu) == 65535u ? 1u : 2u;
}

/// How many more depths the texel holds then.
uint raise(uint texel, uint depth) {
    uint seen = outermost[texel];  // words only grow: what is within them stays so
    for (;;) {
        uint word = raised(seen, depth);
        if (word == seen) return 0u;
        uint found = atomicCompSwap(outermost[texel], seen, word);
        if (found == seen) return held(word) - held(seen);
        seen = found;
    }
}

void main() {
    if (gl_LocalInvocationIndex == 0u) left_out = 0u;
    barrier();
    uint index = list_index();
    if (index < min(fragment_count, uint(fragments.length()))) {
        LdmFragment fragment = fragments[index];
        if (raise(batch_texel + fragment.texel, fragment.arrival_depth & 0xffffu) == 0u) atomicAdd(left_out, 1u);
    }
    barrier();
    if (gl_LocalInvocationIndex != 0u || left_out == 0u) return;
    atomicAdd(between, left_out);
    atomicAdd(chunk_total, 0u - left_out);
}
