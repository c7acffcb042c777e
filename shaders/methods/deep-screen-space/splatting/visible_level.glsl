// Uniforms of splat_level(); set_splat_level sets them (renderers/methods/deep-screen-space/splatting/visible.h).
#include "methods/deep-screen-space/splatting/visible_hit.glsl"

uniform float first_shell, coverage, max_distance;
uniform bool full_discs;

SplatLevel splat_level(int level) {
    return SplatLevel(level, first_shell, coverage, max_distance, full_discs);
}
