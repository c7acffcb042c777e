// Per pixel and sample the finest level that has a hit: its results are the most precise. [Nalbach15 §4.2]
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/places.glsl"
#include "methods/deep-screen-space/splatting/visible_hit.glsl"
#include "passes/bounce/tiles.glsl"

layout(std430, binding = 0) readonly buffer Surfels { Surfel surfels[]; };

layout(binding = 0) uniform usampler2DArray places;
layout(binding = 1) uniform usampler2DArray winners;  // a layer per sample and level
layout(binding = 2) uniform sampler2D positions;
layout(binding = 3) uniform sampler2DArray directions;
layout(binding = 0, r32f) uniform writeonly image2DArray distance_image;
layout(binding = 1, r32ui) uniform writeonly uimage2DArray nearest_image;
layout(binding = 2, r16f) uniform writeonly image2DArray level_image;

uniform int levels, samples;

struct Winner {
    uint surfel;  // 1 + index; 0: none
    int level;    // -1: none
};

Winner finest_winner(ivec2 pixel, int sample_index) {
    for (int level = 0; level < levels; ++level) {
        ivec2 place = unpacked_place(texelFetch(places, ivec3(pixel, level), 0).x);
        uint surfel = texelFetch(winners, ivec3(place, sample_index * levels + level), 0).x;
        if (surfel != 0u) return Winner(surfel, level);
    }
    return Winner(0u, -1);
}

/// Of the plane that was hit, anew: z of large discs is rounded more.
float distance_of(Winner winner, ivec2 pixel, int sample_index) {
    if (winner.surfel == 0u) return -1.0;
    Surfel s = surfels[winner.surfel - 1u];
    return splat_plane_distance(texelFetch(positions, pixel, 0).xyz,
                                texelFetch(directions, ivec3(pixel, sample_index), 0).xyz, s.centre_ws, s.normal_ws);
}

void main() {
    ivec2 pixel = tile_pixel();
    if (any(greaterThanEqual(pixel, imageSize(distance_image).xy))) return;
    for (int i = 0; i < samples; ++i) {
        Winner winner = finest_winner(pixel, i);
        imageStore(distance_image, ivec3(pixel, i), vec4(distance_of(winner, pixel, i)));
        imageStore(nearest_image, ivec3(pixel, i), uvec4(winner.surfel));
        imageStore(level_image, ivec3(pixel, i), vec4(winner.level));
    }
}
