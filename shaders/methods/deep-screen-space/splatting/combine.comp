// Per pixel and sample the level that decides: where shells begin at the same d for all surfels the finest that has a
// hit, as its results are the most precise.  [Nalbach15 §4.2]
// DEVIATION [Nalbach15 §4.2]: where d differs from surfel to surfel, levels are no ranges of distance, and a far hit
// of a large surfel's first level would hide a near one of a small surfel's second: the nearest hit decides.
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/places.glsl"
#include "methods/deep-screen-space/splatting/visible_hit.glsl"
#include "methods/deep-screen-space/splatting/exact.glsl"
#include "passes/bounce/tiles.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };

uniform usampler2DArray places;
uniform usampler2DArray winners;  // a layer per sample and level
uniform sampler2D gbuffer_position;
uniform sampler2DArray directions;
uniform sampler2DArray depths;  // as winners
layout(r32f) uniform writeonly image2DArray distance_image;
layout(r32ui) uniform writeonly uimage2DArray nearest_image;
layout(r16f) uniform writeonly image2DArray level_image;

uniform int levels, samples;
uniform bool nearest_decides;

struct Winner {
    uint surfel;  // 1 + index, or EXACT_HIT | triangle; 0: none
    int level;    // -1: none
};

Winner winner_of(ivec2 pixel, int sample_index) {
    Winner winner = Winner(0u, -1);
    float least = 2.0;
    for (int level = 0; level < levels; ++level) {
        ivec3 at = ivec3(unpacked_place(texelFetch(places, ivec3(pixel, level), 0).x), sample_index * levels + level);
        uint surfel = texelFetch(winners, at, 0).x;
        if (surfel == 0u) continue;
        float z = nearest_decides ? texelFetch(depths, at, 0).x : 0.0;
        if (z >= least) continue;
        least = z;
        winner = Winner(surfel, level);
        if (!nearest_decides) break;
    }
    return winner;
}

/// Of the plane that was hit, anew: z of large discs is rounded more.
float distance_of(Winner winner, ivec2 pixel, int sample_index) {
    if (winner.surfel == 0u) return -1.0;
    Surfel s = surfels[winner.surfel - 1u];
    return splat_plane_distance(texelFetch(gbuffer_position, pixel, 0).xyz,
                                texelFetch(directions, ivec3(pixel, sample_index), 0).xyz, s.centre_ws, s.normal_ws);
}

void main() {
    ivec2 pixel = tile_pixel();
    if (any(greaterThanEqual(pixel, imageSize(distance_image).xy))) return;
    for (int i = 0; i < samples; ++i) {
        Winner winner = winner_of(pixel, i);
        float distance_m = distance_of(winner, pixel, i);
#if EXACT
        uvec2 exact = texelFetch(exact_rays, ivec3(pixel, i), 0).xy;
        if (exact.x != 0u) {
            winner = Winner(EXACT_HIT | (exact.x - 1u), 0);
            distance_m = uintBitsToFloat(exact.y);
        }
#endif
        imageStore(distance_image, ivec3(pixel, i), vec4(distance_m));
        imageStore(nearest_image, ivec3(pixel, i), uvec4(winner.surfel));
        imageStore(level_image, ivec3(pixel, i), vec4(winner.level));
    }
}
