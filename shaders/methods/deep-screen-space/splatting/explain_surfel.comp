// The splats of one surfel on each level: which pixels they covered, and what became of them there.
#include "lib/floats.glsl"
#include "methods/deep-screen-space/splatting/explain_splat.glsl"
#include "passes/bounce/tiles.glsl"

layout(std430) readonly buffer Choice { uint closeness, surfel; };
/// As fields of "splats.explain.surfel".
// C++: ir::methods::deep_screen_space::SurfelSum
struct SurfelSum {
    float centre[3], normal[3], radius;
    uint surfel, level, splats, hits, level_wins, wins;
};
layout(std430) buffer Sums { SurfelSum sums[]; };
layout(std430) buffer SumCount { uint sum_count; };

uniform sampler2DArray hit_levels;
layout(r16f) uniform image2DArray cover_image;

int cover_of(Surfel s, uint index, int level, int j, ivec2 pixel, vec3 x_ws, vec3 normal_ws) {
    ivec2 place = place_of(pixel, level);
    vec4 direction = texelFetch(directions, ivec3(pixel, j), 0);
    if (direction == vec4(0) || !is_in_sub_image(s, level, first_sample + j, place)) return SPLAT_NONE;
    int outcome = explained_splat(s, level, pixel, j, x_ws, direction.xyz, normal_ws).hit.outcome;
    if (outcome != SPLAT_HIT || texelFetch(winners, ivec3(place, j * levels + level), 0).x != index + 1u) return outcome;
    bool wins = int(texelFetch(hit_levels, ivec3(pixel, j), 0).x) == level;
    return wins ? SPLAT_WINS : SPLAT_LEVEL;
}

void count(int level, int cover) {
    if (cover == SPLAT_NONE || level >= sums.length()) return;
    atomicAdd(sums[level].splats, 1u);
    if (cover >= SPLAT_HIT) atomicAdd(sums[level].hits, 1u);
    if (cover >= SPLAT_LEVEL) atomicAdd(sums[level].level_wins, 1u);
    if (cover >= SPLAT_WINS) atomicAdd(sums[level].wins, 1u);
}

/// Of all samples the one that went farthest.
int cover_of_level(Surfel s, uint index, int level, ivec2 pixel) {
    vec3 normal_ws = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    if (normal_ws == vec3(0) || !is_in_range(splat_range(s, level), pixel, level)) return SPLAT_NONE;
    vec3 x_ws = texelFetch(gbuffer_position, pixel, 0).xyz;
    int most = SPLAT_NONE;
    for (int j = 0; j < samples; ++j) {
        int cover = cover_of(s, index, level, j, pixel, x_ws, normal_ws);
        count(level, cover);
        most = max(most, cover);
    }
    return most;
}

void begin_sums(Surfel s, uint index) {
    for (int level = 0; level < levels && level < sums.length(); ++level) {
        sums[level].centre = floats(s.centre_ws);
        sums[level].normal = floats(s.normal_ws);
        sums[level].radius = splat_disc_radius(splat_level(level, s), level, s.radius);
        sums[level].surfel = index + 1u;
        sums[level].level = uint(level);
    }
    atomicAdd(sum_count, uint(levels));
}

void main() {
    ivec2 pixel = tile_pixel();
    uint index = surfel - 1u;  // 0: none, beyond all
    bool exists = index < stored;
    if (exists && first_sample == 0 && pixel == ivec2(0)) begin_sums(surfels[index], index);
    if (any(greaterThanEqual(pixel, imageSize(cover_image).xy))) return;
    for (int level = 0; level < levels; ++level) {
        int cover = exists ? cover_of_level(surfels[index], index, level, pixel) : SPLAT_NONE;
        if (first_sample > 0) cover = max(cover, int(imageLoad(cover_image, ivec3(pixel, level)).x));
        imageStore(cover_image, ivec3(pixel, level), vec4(cover));
    }
}
