// What becomes of a surfel's splat on one pixel, with visibility.
#include "methods/deep-screen-space/splatting/splat_search.glsl"
#include "methods/deep-screen-space/splatting/visible_hit.glsl"
#include "methods/deep-screen-space/splatting/accepted.glsl"

uniform sampler2D gbuffer_position;
uniform sampler2DArray directions;
uniform sampler2D gbuffer_geometric_normal;
uniform usampler2DArray winners;

uniform int samples, first_sample;  // of the batch

struct ExplainedSplat {
    int shell;
    SplatHit hit;
};

ExplainedSplat explained_splat(Surfel s, int level, ivec2 pixel, int sample_index, vec3 x_ws, vec3 direction_ws,
                               vec3 geometric_normal_ws) {
    SplatLevel l = splat_level(level, s);
    ExplainedSplat e = ExplainedSplat(splat_shell(l, x_ws, s.centre_ws), SplatHit(SPLAT_OUTSIDE, 0.0, 1.0, 0.0));
    if (e.shell < 0) return e;
    e.hit = splat_hit(l, e.shell, x_ws, direction_ws, s.centre_ws, s.normal_ws, s.radius);
    if (e.hit.outcome == SPLAT_HIT &&
        !splat_is_accepted(s, e.hit, pixel, sample_index, x_ws, direction_ws, geometric_normal_ws))
        e.hit.outcome = SPLAT_REFUSED;
    return e;
}
