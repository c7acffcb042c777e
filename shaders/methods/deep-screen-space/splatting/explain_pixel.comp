// All splats onto one pixel, found over all surfels.
layout(local_size_x = 64) in;

#include "lib/floats.glsl"
#include "methods/deep-screen-space/splatting/explain_splat.glsl"

/// As fields of "splats.explain.candidates".
// C++: ir::methods::deep_screen_space::SplatCandidate
struct Candidate {
    float centre[3], normal[3], radius;
    uint surfel, sample_, level, shell, outcome;
    float distance, z;
};
layout(std430) writeonly buffer Candidates { Candidate candidates[]; };
/// As fields of "splats.explain.levels"; the host fills in what was found.
// C++: ir::methods::deep_screen_space::LevelSum
struct LevelSum {
    uint sample_, level, splats;
    uint outside, missed, too_far, refused, hits;  // splats by outcome
    uint found, kept, nearest;
    float found_z, kept_z;
};
layout(std430) buffer Sums { LevelSum sums[]; };
layout(std430) buffer CandidateCount { uint candidate_count; };
layout(std430) buffer SumCount { uint sum_count; };

uniform sampler2DArray depths;

uniform uint first_item, end_item;
uniform ivec2 picked;  // negative: none

void write_candidate(Surfel s, uint index, int sample_index, int level, ExplainedSplat e) {
    uint at = atomicAdd(candidate_count, 1u);
    if (at >= uint(candidates.length())) return;
    candidates[at] =
        Candidate(floats(s.centre_ws),
                  floats(s.normal_ws), e.hit.disc_radius, index + 1u,
                  uint(first_sample + sample_index), uint(level), uint(e.shell), uint(e.hit.outcome),
                  isinf(e.hit.distance_m) || isnan(e.hit.distance_m) ? 0.0 : e.hit.distance_m, e.hit.z);
}

void explain(Surfel s, uint index, int level, int sample_index, ivec2 place, vec3 x_ws, vec3 normal_ws) {
    if (!is_in_sub_image(s, level, first_sample + sample_index, place)) return;
    vec4 direction = texelFetch(directions, ivec3(picked, sample_index), 0);
    if (direction == vec4(0)) return;
    ExplainedSplat e = explained_splat(s, level, picked, sample_index, x_ws, direction.xyz, normal_ws);
    int row = (first_sample + sample_index) * levels + level;
    atomicAdd(sums[row].splats, 1u);
    if (e.hit.outcome == SPLAT_OUTSIDE) atomicAdd(sums[row].outside, 1u);
    if (e.hit.outcome == SPLAT_MISSED) atomicAdd(sums[row].missed, 1u);
    if (e.hit.outcome == SPLAT_TOO_FAR) atomicAdd(sums[row].too_far, 1u);
    if (e.hit.outcome == SPLAT_REFUSED) atomicAdd(sums[row].refused, 1u);
    if (e.hit.outcome == SPLAT_HIT) atomicAdd(sums[row].hits, 1u);
    if (e.hit.outcome != SPLAT_OUTSIDE) write_candidate(s, index, sample_index, level, e);
}

/// What the framebuffer holds.
void begin_sums() {
    for (int layer = 0; layer < samples * levels; ++layer) {
        int row = first_sample * levels + layer;
        if (row >= sums.length()) break;
        ivec3 at = ivec3(place_of(picked, layer % levels), layer);
        sums[row].sample_ = uint(row / levels);
        sums[row].level = uint(row % levels);
        sums[row].kept = texelFetch(winners, at, 0).x;
        sums[row].kept_z = texelFetch(depths, at, 0).x;
    }
    atomicAdd(sum_count, uint(samples * levels));
}

void main() {
    if (picked.x < 0) return;
    vec3 normal_ws = texelFetch(gbuffer_geometric_normal, picked, 0).xyz;
    if (normal_ws == vec3(0)) return;
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i == 0u) begin_sums();
    if (i >= min(end_item, stored) || sums.length() < (first_sample + samples) * levels) return;
    Surfel s = surfels[i];
    vec3 x_ws = texelFetch(gbuffer_position, picked, 0).xyz;
    for (int level = 0; level < levels; ++level) {
        if (!is_in_range(splat_range(s, level), picked, level)) continue;
        ivec2 place = place_of(picked, level);
        for (int j = 0; j < samples; ++j) explain(s, i, level, j, place, x_ws, normal_ws);
    }
}
