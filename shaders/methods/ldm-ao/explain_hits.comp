// Gathers the accessibility of one pixel again, direction by direction: one invocation queries one map of the batch,
// and writes the region of v, that of -v, and the ray that was queried. [Aalund15 eq. 2]
layout(local_size_x = 64) in;
#include "methods/ldm-ao/explained.glsl"
#include "methods/ldm-ao/visibility.glsl"

/// Of "ldm.directions": v and -v of each map in turn, REGION_WORDS each.
layout(std430) readonly buffer Regions { uint regions[]; };
/// The same, each with hit, distance, contribution and own_found behind.
layout(std430) writeonly buffer Hits { uint hits[]; };
// C++: ir::methods::ldm_ao::QueriedRay
struct QueriedRay {
    float start[3], end[3];
    int hit;
    float distance, contribution;
    uint map;
    int side;
};
layout(std430) writeonly buffer Rays { QueriedRay rays[]; };
layout(std430) buffer HitCount { uint hit_count; };
layout(std430) buffer RayCount { uint ray_count; };

uniform uint first_frame, map_count, all_maps;  // of the batch; among all

const int HIT = 1, MISS = 0, BELOW = -1;

shared float partial_sums[64];

/// Σ cosθ over all maps, as every work group needs it.
float sum_of_cosines(vec3 normal) {
    uint me = gl_LocalInvocationID.x;
    float sum = 0.0;
    for (uint i = me; i < all_maps; i += 64u) sum += abs(dot(normal, ldm_frames[i].direction.xyz));
    partial_sums[me] = sum;
    barrier();
    for (uint half_size = 32u; half_size > 0u; half_size >>= 1) {
        if (me < half_size) partial_sums[me] += partial_sums[me + half_size];
        barrier();
    }
    return partial_sums[0];
}

void write_region(uint region, int hit, float distance_ws, float contribution, bool own) {
    uint word = (REGION_WORDS + 4u) * region;
    if (word + REGION_WORDS + 4u > uint(hits.length())) return;
    for (uint i = 0u; i < REGION_WORDS; ++i) hits[word + i] = regions[REGION_WORDS * region + i];
    hits[word + REGION_WORDS] = floatBitsToUint(float(hit));
    hits[word + REGION_WORDS + 1u] = floatBitsToUint(distance_ws);
    hits[word + REGION_WORDS + 2u] = floatBitsToUint(contribution);
    hits[word + REGION_WORDS + 3u] = own ? 1u : 0u;
}

void write_ray(QueriedRay ray) {
    if (ray.map < uint(rays.length())) rays[ray.map] = ray;
}

void main() {
    Surface x = explained_surface();
    float all_cosines = sum_of_cosines(x.normal);
    if (!x.exists || gl_GlobalInvocationID.x >= map_count) return;
    uint map = first_frame + gl_GlobalInvocationID.x;
    MapFrame frame = ldm_frames[map];
    float cosine = dot(x.normal, frame.direction.xyz);
    bool forward = cosine > 0.0;
    cosine = abs(cosine);
    float facing = dot(x.geometric_normal, frame.direction.xyz);
    int side = forward ? 1 : -1, hit = BELOW;
    vec3 direction = float(side) * frame.direction.xyz;
    float distance_ws = 0.0, contribution = 0.0;
    bool own = false;
    if (cosine != 0.0 && (forward ? facing > 0.0 : facing < 0.0)) {
        LdmHit found = ldm_trace(frame, gl_GlobalInvocationID.x, x.position, x.geometric_normal, forward,
                                 reach_quanta(frame));
        hit = found.found ? HIT : MISS;
        own = found.own;
        distance_ws = found.found ? max(found.distance, 0.0) * frame.direction.w
                                  : open_length(x.position, direction);
        contribution = openness(found.found, distance_ws) * cosine / all_cosines;
    }
    write_region(2u * map + (forward ? 0u : 1u), hit, distance_ws, contribution, own);
    write_region(2u * map + (forward ? 1u : 0u), BELOW, 0.0, 0.0, false);
    write_ray(QueriedRay(floats(x.position), floats(x.position + distance_ws * direction), hit, distance_ws, contribution,
                       map, side));
    atomicAdd(hit_count, 2u);
    atomicAdd(ray_count, 1u);
}
