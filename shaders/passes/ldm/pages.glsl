// Paged per-pixel linked lists. [Crassin10] heads: first page of each texel; pages: the next one, and LDM_PAGE_DEPTHS
// sorted depths, two per word; behind the last one of all 65535. Pages count from 1; 0 ends a list.
layout(std430) readonly buffer LdmPageHeads { uint heads[]; };
layout(std430) readonly buffer LdmPages { uint pages[]; };

const uint PAGE_DEPTHS = uint(LDM_PAGE_DEPTHS), PAGE_WORDS = 1u + PAGE_DEPTHS / 2u;
const uint NO_DEPTH = 65535u;

uint first_page(uint map, ivec2 texel, int resolution) {
    return heads[(map * uint(resolution) + uint(texel.y)) * uint(resolution) + uint(texel.x)];
}

uint page_depth(uint page, uint slot) {
    return bitfieldExtract(pages[(page - 1u) * PAGE_WORDS + 1u + slot / 2u], int(slot & 1u) << 4, 16);
}

LdmNeighbours ldm_neighbours(uint map, ivec2 texel, int resolution, int depth) {
    LdmNeighbours result = LdmNeighbours(LDM_NONE_BEFORE, LDM_NONE_BEHIND);
    // NO_DEPTH is no entry, whatever depth is queried.
    uint queried = uint(clamp(depth, 0, int(NO_DEPTH)));
    for (uint page = first_page(map, texel, resolution); page != 0u; page = pages[(page - 1u) * PAGE_WORDS]) {
        uint last = page_depth(page, PAGE_DEPTHS - 1u);
        if (last < queried) {
            result.before = int(last);
            continue;
        }
        for (uint slot = 0u; slot < PAGE_DEPTHS; ++slot) {
            uint found = page_depth(page, slot);
            if (found >= queried) {
                if (found != NO_DEPTH) result.behind = int(found);
                return result;
            }
            result.before = int(found);
        }
    }
    return result;
}

// Where a cursor has a slot that holds NO_DEPTH, the sequence is at its end.
LdmCursor ldm_first(uint map, ivec2 texel, int resolution) {
    return LdmCursor(first_page(map, texel, resolution), 0u);
}
int ldm_depth(LdmCursor cursor) { return int(page_depth(cursor.at, cursor.end)); }
bool ldm_valid(LdmCursor cursor) { return cursor.at != 0u && ldm_depth(cursor) != int(NO_DEPTH); }
LdmCursor ldm_next(LdmCursor cursor) {
    if (cursor.end + 1u < PAGE_DEPTHS) return LdmCursor(cursor.at, cursor.end + 1u);
    return LdmCursor(pages[(cursor.at - 1u) * PAGE_WORDS], 0u);
}
