// Sparse arrays, first step: one invocation counts what the fragments of 32 texels take.
layout(local_size_x = 64) in;
#include "passes/ldm/sparse_builder.glsl"

void main() {
    uint word = gl_GlobalInvocationID.x;
    if (word >= word_count) return;
    uvec2 texels = texels_of(word);
    uint occupied = 0u, sum = 0u, most = 0u, deep = 0u;
    for (uint texel = texels.x; texel < texels.y; ++texel) {
        uint count = min(counts[texel], MAX_LAYERS);
        occupied |= (count > 0u ? 1u : 0u) << (texel - texels.x);
        sum += count;
        most = max(most, count);
        deep += count > FEW_LAYERS ? 1u : 0u;
    }
    uint offsets_kept = uint(max(bitCount(occupied) - 1, 0));
    sums[word] = LdmWord(occupied, sum > 65535u ? 2u * offsets_kept | WIDE : offsets_kept, sum);
    atomicMax(max_layers, most);
    if (deep > 0u) atomicAdd(deep_texels, deep);
}
