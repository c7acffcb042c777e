// What a triangle takes from a point's accessibility in the additive form. [McGuire10]
#include "methods/ambient-occlusion-volumes/volume.glsl"
#include "methods/ambient-occlusion-volumes/form_factor.glsl"
#include "passes/raytracing/ray_offset.glsl"

uniform float reach;

/// ḡ, the product of four clamped distances to the volume's planes: 1 on the triangle, 0 on all of them.
/// DEVIATION [McGuire10]: with the hard fall-off 1 in the whole volume. Either way a triangle counts as a whole,
/// with its parts that are farther away than the maximum distance.
float falloff_weight(Volume v, vec3 x) {
    if (params.falloff == FALLOFF_HARD) return 1.0;
    float g = 1.0 - abs(height_over(v, x)) / reach;
    for (int i = 0; i < 3; ++i) g *= clamp(1.0 - beyond_edge(v, i, x) / reach, 0.0, 1.0);
    return max(g, 0.0);
}

/// x: the origin above the surface, n: its shading normal.
float form_factor_of(Volume v, vec3 x, vec3 n) {
    vec3 p[3] = vec3[](v.corners[0] - x, v.corners[1] - x, v.corners[2] - x);
    float f = form_factor(p, n);
    return height_over(v, x) < 0.0 ? -f : f;
}
