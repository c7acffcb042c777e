// The list that both builders append fragments to: what is known of a fragment is its texel (counted through
// the chunk's maps) and its depth in quanta. With LDM_FACES, which needs triangle.glsl first, fragments are not
// listed: they tell points which way their surface looks. With DIRECT they go into the storage at once.
#include "passes/ldm/state.glsl"

#ifdef LDM_FACES
#include "passes/ldm/faces.glsl"
#else
#ifdef LDM_SLOPES
#include "passes/ldm/node.glsl"
#endif
#ifndef DIRECT
struct LdmFragment {
    uint texel;
    uint arrival_depth;  // order of arrival at the texel (where LDM_ARRIVALS is defined) << 16 | depth
#ifdef LDM_SLOPES
    uint slopes;  // codes
#endif
};
layout(std430) buffer LdmFragments { LdmFragment fragments[]; };
#endif
#ifdef LDM_ARRIVALS
layout(std430) coherent buffer LdmCounts { uint counts[]; };
#endif

/// Takes the next `count` places; those beyond the capacity are only counted.
uint reserve_fragments(uint count) {
    return atomicAdd(fragment_count, count);
}

#ifdef LDM_SLOPES
uint triangle_slopes;  // codes of what is rasterised
#endif

#ifndef DIRECT
void put_fragment(uint place, uint texel, uint depth) {
    uint arrival = 0u;
#ifdef LDM_ARRIVALS
    // Also without room for the fragment, so that one attempt learns what all buffers must hold.
    arrival = min(atomicAdd(counts[texel], 1u), 65535u);
#endif
    if (place >= uint(fragments.length())) return;
#ifdef LDM_SLOPES
    fragments[place] = LdmFragment(texel, arrival << 16 | depth, triangle_slopes);
#else
    fragments[place] = LdmFragment(texel, arrival << 16 | depth);
#endif
}
#endif
#endif

/// Depths are kept between these, in quanta.
// C++: ir::passes::ldm::*
const float LDM_FIRST_DEPTH = 1.0, LDM_LAST_DEPTH = 65534.0;

/// Depths are rounded here and nowhere else, so that all storages hold the same numbers.
uint quantised(float depth) {
    return uint(clamp(floor(depth + 0.5), LDM_FIRST_DEPTH, LDM_LAST_DEPTH));
}
