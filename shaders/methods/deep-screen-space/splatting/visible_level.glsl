// A splat's level. Constants: VisibleLevel of renderers/methods/deep-screen-space/splatting/steps.h.
// Include records.glsl before it.
#include "methods/deep-screen-space/splatting/influence.glsl"
#include "methods/deep-screen-space/splatting/visible_hit.glsl"

uniform float coverage, max_distance;
uniform bool full_discs;

SplatLevel splat_level(int level, Surfel surfel) {
    return SplatLevel(level, first_shell(surfel.radius), whole_reach, coverage, max_distance, full_discs,
                      level == open_level);
}
