// What a disc sends that stands for many surfels. AVERAGED: the mean of theirs. Include visible_hit.glsl, and before
// it the surfels, how many are stored, and their light.
#include "lib/random.glsl"

/// How many of them are queried.
// C++: ir::methods::deep_screen_space::disc_light_picks
const int DISC_LIGHT_PICKS = 16;

/// Least cosine between the normals of surfels that one disc stands for.
// C++: ir::methods::deep_screen_space::disc_light_facing
const float DISC_LIGHT_FACING = 0.9;

/// Of the side that is hit. `shell`: which the disc is enlarged for; `random`: uniform in [0, 1), for each ray.
/// DEVIATION [Nalbach15 §4.1]: the disc shows the light of the surfel in its middle. Of 4^l surfels one is drawn, so
/// that small bright places are met by few rays, each for 4^l: blotches. Those before and behind it in their order
/// lie about it.
vec3 light_of_disc(SplatLevel l, uint index, int shell, bool is_front, float random) {
    vec3 own = light_of_side(surfel_lights[index], is_front);
#if AVERAGED
    Surfel s = surfels[index];
    int around = 1 << 2 * shell, picks = min(around, DISC_LIGHT_PICKS);
    float reach = splat_disc_radius(l, shell, s.radius);
    vec3 sum = vec3(0);
    int count = 0;
    for (int i = 0; i < picks; ++i) {
        int other = int(index) + int((float(i) + random) * float(around / picks)) - around / 2;
        if (other < 0 || other >= int(stored)) continue;
        Surfel o = surfels[other];
        vec3 offset = o.centre_ws - s.centre_ws;
        if (o.radius == 0.0 || dot(o.normal_ws, s.normal_ws) < DISC_LIGHT_FACING ||
            dot(offset, offset) > reach * reach)
            continue;
        sum += light_of_side(surfel_lights[other], is_front);
        ++count;
    }
    if (count > 0) return sum / float(count);
#endif
    return own;
}

/// Variance, along each axis, of the slopes of half vectors over the disc as x_p sees it at this distance: half of that
/// of the directions to its points. The highlight is averaged over the disc, too.
float disc_slope_variance(float surfel_radius, int shell, float distance_m) {
#if AVERAGED
    float wide = ldexp(surfel_radius, shell) / distance_m;
    return wide * wide / 16.0;
#else
    return 0.0;
#endif
}
