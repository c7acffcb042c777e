// Which source a point of the frame's emission sets belongs to, and its place in the unit square. Before
// including, declare records.glsl's `Source sources[]`.

#include "methods/photon-mapping/emission/emission_set.glsl"
#include "methods/photon-mapping/emission/seeds.glsl"

uniform uint source_count;  // layers of the RSM
uniform uint strata;

/// The same number of turns for all items: llvmpipe (Mesa 22.3) gave neighbours of a source's first point wrong
/// results after a search that ended when it had found.
uint source_of_item(uint item) {
    uint source = 0u;
    for (uint i = 1u; i < source_count; ++i) source += item >= sources[i].first_point ? 1u : 0u;
    return source;
}

EmissionSet emission_set_of(uint source) {
    return EmissionSet(sources[source].points, stratum, strata,
                       emission_shift(source, uvec2(seed_low, seed_high)));
}

const uint CANDIDATE_SURVIVES = 1u << 26u;

uint packed_candidate(uvec2 texel, uint source, bool survives) {
    return texel.x | texel.y << 10u | source << 20u | (survives ? CANDIDATE_SURVIVES : 0u);
}
