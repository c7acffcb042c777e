// Lists that are sorted after, second step: one invocation sorts one texel's depths in registers; links stay as they
// are. Texels with more than FEW_LAYERS are listed for lists_sort_deep.comp, where they do not hold up their
// neighbours. [Yang10 §4]
layout(local_size_x = 128) in;
#include "passes/ldm/lists_builder.glsl"
#include "passes/ldm/networks.glsl"

void main() {
    uint texel = gl_GlobalInvocationID.x;
    if (texel >= texel_count) return;
    uint count = counts[texel], head = heads[batch_texel + texel], node = head;
    if (count > FEW_LAYERS) {
        uint place = atomicAdd(deep_listed, 1u);
        if (place < uint(deep_list.length())) deep_list[place] = texel;
        return;
    }
    if (count < 2u) return;
    uint v[16];
    for (int i = 0; i < 16; ++i) {
        v[i] = 65535u;
        if (node != 0u) {
            uvec2 entry = nodes[node - 1u];
            v[i] = entry.y;
            node = entry.x;
        }
    }
    SORT_16(0)
    node = head;
    for (int i = 0; i < 16; ++i) {
        if (node == 0u) break;
        nodes[node - 1u].y = v[i];
        node = nodes[node - 1u].x;
    }
}
