// By how much accessibility changes where one direction is left out: over the pixels of the grid that show
// a surface the mean change, and the root of its mean square. A work group has one map, and writes the
// regions of v and -v.
layout(local_size_x = 64) in;
#include "passes/ldm/effect_pixels.glsl"
#include "passes/ldm/frames.glsl"

/// Of "ldm.directions": v and -v of each map in turn, REGION_WORDS each.
layout(std430) readonly buffer Regions { uint regions[]; };
layout(std430) readonly buffer Openness { float openness_of[]; };
layout(std430) readonly buffer EffectSums { float sums[]; };
/// Regions, each with the root of the mean square and the mean behind.
layout(std430) writeonly buffer Effects { uint effects[]; };
#ifdef OF_PICKED_PIXEL
layout(std430) buffer EffectCount { uint effect_count; };
#endif

shared vec4 partial_changes[64];  // along v: sum, sum of squares; along -v
shared float partial_counts[64];

/// A = Σ V cosθ / Σ cosθ without one direction, minus A.
float change_without(vec2 sum, float open, float cosine) {
    float others = sum.y - cosine;
    return others > 0.0 ? cosine * (sum.x / sum.y - open) / others : 0.0;
}

void write_region(uint region, vec2 change, float count) {
    uint word = (REGION_WORDS + 2u) * region;
    if (word + REGION_WORDS + 2u > uint(effects.length())) return;
    for (uint i = 0u; i < REGION_WORDS; ++i) effects[word + i] = regions[REGION_WORDS * region + i];
    effects[word + REGION_WORDS] = floatBitsToUint(count > 0.0 ? sqrt(change.y / count) : 0.0);
    effects[word + REGION_WORDS + 1u] = floatBitsToUint(count > 0.0 ? change.x / count : 0.0);
}

void main() {
    uint me = gl_LocalInvocationID.x, map = gl_WorkGroupID.x;
    vec3 direction = ldm_frames[map].direction.xyz;
    vec4 changes = vec4(0.0);
    float count = 0.0;
    for (uint pixel = me; pixel < pixel_count(); pixel += 64u) {
        vec2 sum = vec2(sums[2u * pixel], sums[2u * pixel + 1u]);
        if (sum.y <= 0.0) continue;
        float cosine = dot(surface_of(pixel).normal, direction);
        float change = change_without(sum, openness_of[map * pixel_count() + pixel], abs(cosine));
        vec2 added = vec2(change, change * change);
        changes += cosine > 0.0 ? vec4(added, 0.0, 0.0) : vec4(0.0, 0.0, added);
        count += 1.0;
    }
    partial_changes[me] = changes;
    partial_counts[me] = count;
    barrier();
    for (uint half_size = 32u; half_size > 0u; half_size >>= 1) {
        if (me < half_size) {
            partial_changes[me] += partial_changes[me + half_size];
            partial_counts[me] += partial_counts[me + half_size];
        }
        barrier();
    }
    if (me != 0u) return;
#ifdef OF_PICKED_PIXEL
    if (partial_counts[0] == 0.0) return;
    atomicAdd(effect_count, 2u);
#endif
    write_region(2u * map, partial_changes[0].xy, partial_counts[0]);
    write_region(2u * map + 1u, partial_changes[0].zw, partial_counts[0]);
}
