// Questions to the maps, the same for every storage. Each texel holds a sorted sequence of depths in quanta.
// Before including, define what the storage's `defines` says (renderers/passes/ldm/storage.h).

#include "lib/random.glsl"
#ifdef LDM_SLOPES
#include "passes/ldm/node.glsl"
#endif

/// The depths around a given one: the last below it, and the first that is not.
struct LdmNeighbours {
    int before, behind;
};
/// Beyond all depths, which have 16 bits.
// C++: ir::passes::ldm::*
const int LDM_NONE_BEFORE = -1000000, LDM_NONE_BEHIND = 1000000;

/// A place in a texel's sequence:
///   for (LdmCursor c = ldm_first(map, texel, resolution); ldm_valid(c); c = ldm_next(c)) … ldm_depth(c) …
struct LdmCursor {
    uint at, end;
};

// Each storage defines, `map` counting from the batch's first one:
//   LdmNeighbours ldm_neighbours(uint map, ivec2 texel, int resolution, int depth)
//   LdmCursor ldm_first(uint map, ivec2 texel, int resolution), ldm_next(LdmCursor)
//   bool ldm_valid(LdmCursor); int ldm_depth(LdmCursor)
//   LdmNeighbours ldm_any(uint map, ivec2 texel, int resolution, int depth, bool behind), or the one below:
//     Whether there is anything on the queried side, as any of its entries, for the least work. Where there is
//     none, the other side's nearest entry is given.
#if defined(LDM_LINKED_LISTS)
#include "passes/ldm/lists.glsl"
#elif defined(LDM_ARRAYS)
#include "passes/ldm/arrays.glsl"
#elif defined(LDM_SPARSE_ARRAYS)
#include "passes/ldm/sparse.glsl"
#elif defined(LDM_FIXED)
#include "passes/ldm/fixed.glsl"
#elif defined(LDM_HASH)
#include "passes/ldm/hash.glsl"
#elif defined(LDM_PEELED)
#include "passes/ldm/peel.glsl"
#elif defined(LDM_PACKED_BITS)
#include "passes/ldm/packed.glsl"
#elif defined(LDM_OUTERMOST)
#include "passes/ldm/outermost.glsl"
#elif defined(LDM_PAGES)
#include "passes/ldm/pages.glsl"
#endif
// A file is included once, whatever conditions it stands under: what several storages share stands here.
#if defined(LDM_ARRAYS) || defined(LDM_SPARSE_ARRAYS) || defined(LDM_PACKED_BITS)
#include "passes/ldm/depth_ranges.glsl"
#else
LdmNeighbours ldm_any(uint map, ivec2 texel, int resolution, int depth, bool behind) {
    if (behind) return ldm_neighbours(map, texel, resolution, depth);
    LdmNeighbours result = LdmNeighbours(LDM_NONE_BEFORE, LDM_NONE_BEHIND);
    LdmCursor cursor = ldm_first(map, texel, resolution);
    if (!ldm_valid(cursor)) return result;
    int first = ldm_depth(cursor);
    if (first < depth)
        result.before = first;
    else
        result.behind = first;
    return result;
}
#endif
