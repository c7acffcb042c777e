// Packed arrays, fourth step: where each texel begins. One invocation: one row. Groups whose depths have no room yet
// are empty.
layout(local_size_x = 64) in;
#include "passes/ldm/packed_builder.glsl"

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= row_count) return;
    uint room = packed_room(), base = rows[first_row + row], begin = 0u;
    uint group_count = groups_of_row(resolution);
    for (uint g = 0u; g < group_count; ++g) {
        uint of_texel[8], first = begin, most = 0u;
        for (uint t = 0u; t < GROUP_TEXELS; ++t) {
            uint x = g * GROUP_TEXELS + t, texel = row * resolution + x;
            of_texel[t] = x < resolution ? packed_texels[texel] : 0u;
            if (x < resolution) packed_texels[texel] = base + begin;
            begin += of_texel[t];
            most = max(most, of_texel[t]);
        }
        uvec2 words = uvec2(0u);
        if (first >= WIDE_GROUP || most > MAX_IN_GROUP) {
            uint wide = table_words + WIDE_WORDS * atomicAdd(batch_extra, 1u);
            if (wide + WIDE_WORDS <= uint(groups.length()) && base + begin <= room) {
                words = uvec2(WIDE_GROUP, wide);
                for (uint t = 0u; t < GROUP_TEXELS; ++t) {
                    groups[wide + t] = first;
                    first += of_texel[t];
                }
                groups[wide + GROUP_TEXELS] = first;
            }
        } else if (base + begin <= room) {
            words = group_words(first, of_texel);
        }
        uint place = GROUP_WORDS * ((first_row + row) * group_count + g);
        if (place + 1u >= uint(groups.length())) continue;
        groups[place] = words.x;
        groups[place + 1u] = words.y;
    }
    if (row + 1u == row_count) packed_texels[row_count * resolution] = base + begin;
}
