// Copies the sequences of a batch's texels out of its maps, through the cursor, and compares what the other questions
// answer with them (in large maps at every 16th texel). One invocation: one texel; y: map.
layout(local_size_x = 64) in;
#include "passes/ldm/storage.glsl"

/// First depth and number of depths of each texel of all maps.
layout(std430) buffer Texels { uvec2 out_texels[]; };
layout(std430) buffer Out { uint out_depths[]; };
layout(std430) buffer Copied { uint copied; };
layout(std430) buffer Wrong { uint wrong_answers; };

uniform uint first_map;  // of the batch
uniform int resolution;

bool is_wrong(uint map, ivec2 texel, int depth) {
    LdmNeighbours expected = LdmNeighbours(LDM_NONE_BEFORE, LDM_NONE_BEHIND);
    for (LdmCursor c = ldm_first(map, texel, resolution); ldm_valid(c); c = ldm_next(c)) {
        int found = ldm_depth(c);
        if (found < depth) expected.before = found;
        if (found >= depth) expected.behind = min(expected.behind, found);
    }
    LdmNeighbours near = ldm_neighbours(map, texel, resolution, depth);
    LdmNeighbours before = ldm_any(map, texel, resolution, depth, false);
    LdmNeighbours behind = ldm_any(map, texel, resolution, depth, true);
    bool any_before = expected.before != LDM_NONE_BEFORE, any_behind = expected.behind != LDM_NONE_BEHIND;
    return near != expected || (before.before != LDM_NONE_BEFORE) != any_before || before.before >= depth ||
           (!any_before && before.behind != expected.behind) ||
           (behind.behind != LDM_NONE_BEHIND) != any_behind || behind.behind < depth ||
           (!any_behind && behind.before != expected.before);
}

void main() {
    uint map = gl_GlobalInvocationID.y;
    if (gl_GlobalInvocationID.x >= uint(resolution * resolution)) return;
    ivec2 texel = ivec2(int(gl_GlobalInvocationID.x) % resolution, int(gl_GlobalInvocationID.x) / resolution);
    uint count = 0u;
    int least = 65535, most = 0;
    for (LdmCursor c = ldm_first(map, texel, resolution); ldm_valid(c); c = ldm_next(c)) {
        ++count;
        least = min(least, ldm_depth(c));
        most = max(most, ldm_depth(c));
    }
    uint first = atomicAdd(copied, count), place = first;
    for (LdmCursor c = ldm_first(map, texel, resolution); ldm_valid(c); c = ldm_next(c)) {
        if (place < uint(out_depths.length())) out_depths[place] = uint(ldm_depth(c));
        ++place;
    }
    uint index = ((first_map + map) * uint(resolution) + uint(texel.y)) * uint(resolution) + uint(texel.x);
    out_texels[index] = uvec2(first, count);
    if (resolution > 100 && index % 16u != 0u) return;
    int scattered = int((index * 2654435761u) >> 16);
    int queried[6] = int[6](scattered, least, least + 1, most, most + 1, (least + most) / 2);
    for (int i = 0; i < 6; ++i)
        if (is_wrong(map, texel, queried[i])) atomicAdd(wrong_answers, 1u);
}
