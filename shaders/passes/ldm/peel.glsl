// Planes of depth peeling, by chunk of maps: entry = ~(depth << 16 | order of arrival), 0 where a texel has no further
// layer. LDM_CHUNK_MAPS: maps of a chunk; LDM_PLANE_TEXELS: entries of a plane.
struct LdmPeeledChunk {
    uint first, planes, end;
};
layout(std430) readonly buffer LdmPeeledChunks { LdmPeeledChunk peeled_chunks[]; };
layout(std430) readonly buffer LdmPlanes { uint peeled_planes[]; };

/// Entries of the texel in the first plane and in the one after the last.
uvec2 peeled_range(uint map, ivec2 texel, int resolution) {
    LdmPeeledChunk chunk = peeled_chunks[map / LDM_CHUNK_MAPS];
    uint side = uint(resolution);
    uint first = chunk.first + ((map % LDM_CHUNK_MAPS) * side + uint(texel.y)) * side + uint(texel.x);
    return uvec2(first, first + chunk.planes * LDM_PLANE_TEXELS);
}

int peeled_depth(uint entry) { return int(~peeled_planes[entry] >> 16); }

LdmNeighbours ldm_neighbours(uint map, ivec2 texel, int resolution, int depth) {
    LdmNeighbours result = LdmNeighbours(LDM_NONE_BEFORE, LDM_NONE_BEHIND);
    uvec2 range = peeled_range(map, texel, resolution);
    uint low = 0u, high = (range.y - range.x) / LDM_PLANE_TEXELS;
    while (low < high) {
        uint middle = (low + high) >> 1;
        uint entry = range.x + middle * LDM_PLANE_TEXELS;
        bool empty = peeled_planes[entry] == 0u;
        int found = peeled_depth(entry);
        if (!empty && found < depth) {
            result.before = found;
            low = middle + 1u;
        } else {
            if (!empty) result.behind = found;
            high = middle;
        }
    }
    return result;
}

LdmCursor ldm_first(uint map, ivec2 texel, int resolution) {
    uvec2 range = peeled_range(map, texel, resolution);
    return LdmCursor(range.x, range.y);
}
bool ldm_valid(LdmCursor cursor) { return cursor.at < cursor.end && peeled_planes[cursor.at] != 0u; }
int ldm_depth(LdmCursor cursor) { return peeled_depth(cursor.at); }
LdmCursor ldm_next(LdmCursor cursor) { return LdmCursor(cursor.at + LDM_PLANE_TEXELS, cursor.end); }
