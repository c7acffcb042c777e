// All surfels that add to one pixel, found over all surfels. KEPT: components of the framebuffer.
// DARK_IS_IDLE: as in drawn_splat.glsl.
layout(local_size_x = 64) in;

#include "lib/constants.glsl"  // first: a file is included once, and the receiver needs it with LIGHT alone
#include "lib/floats.glsl"
#include "methods/deep-screen-space/splatting/splat_search.glsl"
#include "passes/bounce/receiver.glsl"
#include "methods/deep-screen-space/splatting/additive_share.glsl"

/// As fields of "additive.explain.surfels".
// C++: ir::methods::deep_screen_space::AdditiveShare
struct Given {
    float centre[3], normal[3], radius;
    uint surfel, level;
    float distance, given[3], glossy[3];
};
layout(std430) writeonly buffer Shares { Given shares[]; };
/// As fields of "additive.explain.levels"; the host adds up what was given.
// C++: ir::methods::deep_screen_space::AdditiveLevel
struct LevelShare {
    uint level, surfels;
    float given[3], kept[3];
};
layout(std430) buffer Levels { LevelShare of_levels[]; };
layout(std430) buffer ShareCount { uint share_count; };
layout(std430) buffer LevelCount { uint level_count; };

uniform sampler2DArray splatted;

uniform uint first_item, end_item;
uniform ivec2 picked;  // negative: none

/// What the framebuffer holds.
void begin_levels() {
    for (int level = 0; level < levels && level < of_levels.length(); ++level) {
        of_levels[level].level = uint(level);
        of_levels[level].kept = floats(texelFetch(splatted, ivec3(place_of(picked, level), level), 0).KEPT);
    }
    atomicAdd(level_count, uint(levels));
}

void main() {
    if (picked.x < 0) return;
    Receiver receiver = receiver_at(picked);
    if (!receiver.exists) return;
    vec3 normal_ws = texelFetch(gbuffer_normal, picked, 0).xyz;
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i == 0u) begin_levels();
    if (i >= min(end_item, stored) || of_levels.length() < levels) return;
#if DARK_IS_IDLE
    if (is_dark(surfel_lights[i])) return;  // was not drawn
#endif
    Surfel s = surfels[i];
    for (int level = 0; level < levels; ++level) {
        if (!is_in_range(splat_range(s, level), picked, level) || !is_in_sub_image(s, level, 0, place_of(picked, level)))
            continue;
        Share share = share_of(s, i, level, picked, receiver.position, normal_ws);
        if (!share.counts) continue;
        atomicAdd(of_levels[level].surfels, 1u);
        uint at = atomicAdd(share_count, 1u);
        if (at < uint(shares.length()))
            shares[at] = Given(floats(s.centre_ws), floats(s.normal_ws), s.radius, i + 1u, uint(level),
                               share.distance_m, floats(share.diffuse), floats(share.glossy));
    }
}
