// Normal and depth of pixels, packed once a frame because all filters' neighbours read them, and the
// edge-stopping functions that compare them.

#include "lib/pixel_rays.glsl"
#include "lib/spaces.glsl"

struct FilterSurface {
    vec3 normal;  // geometric, turned to the viewer
    float depth;  // m along the view axis; NO_SURFACE: nothing
};

const float NO_SURFACE = uintBitsToFloat(0x7f800000u);

uniform float sigma_depth, sigma_normal;

/// Part of a depth below which differences do not count. The print's ε has no value; this one keeps the
/// rounding of depths and the bulge of curved surfaces from stopping the filter.
// C++: ir::passes::a_trous::depth_epsilon
const float DEPTH_EPSILON = 1e-3;
/// Part of its depth that a surface may gain within a pixel: edge-on the gradient has no bound, and would let
/// everything in.
// C++: ir::passes::a_trous::steepest
const float STEEPEST = 0.5;

/// The weights of a pixel and of its neighbours one and two steps away. The printed ones sum to 5/4 along a side.
/// [Smal19 §7.3]
// C++: ir::passes::a_trous::*
const float PRINTED_KERNEL[3] = float[3](0.5, 0.25, 0.125);
/// [Dammertz10]
// C++: ir::passes::a_trous::*
const float B3_SPLINE_KERNEL[3] = float[3](0.375, 0.25, 0.0625);
// C++: ir::passes::a_trous::*
const int KERNEL_RADIUS = 2;

bool is_surface(FilterSurface s) { return s.depth < NO_SURFACE; }

uvec2 packed_surface(FilterSurface s) { return uvec2(packed_direction(s.normal), floatBitsToUint(s.depth)); }
FilterSurface unpacked_surface(uvec2 bits) {
    return FilterSurface(unpacked_direction(bits.x), uintBitsToFloat(bits.y));
}

/// ∇z in m per pixel of a plane with normal n at depth z, seen along a ray whose origin and direction change
/// from pixel to pixel: z = n·(a - o) / n·d, differentiated. `d` advances by 1 along the view axis.
vec2 depth_gradient(vec3 n, float z, vec3 d, vec3 o_dx, vec3 o_dy, vec3 d_dx, vec3 d_dy) {
    float facing = -max(abs(dot(n, d)), 1e-6);
    vec2 gradient = -vec2(dot(n, o_dx + z * d_dx), dot(n, o_dy + z * d_dy)) / facing;
    float size = length(gradient), most = STEEPEST * z;
    return size > most ? gradient * (most / size) : gradient;
}

/// In this frame's view.
vec2 depth_gradient(FilterSurface s, vec2 position_px) {
    return depth_gradient(s.normal, s.depth, pixel_ray_direction(position_px), ray_origin_dx, ray_origin_dy,
                          ray_direction_dx, ray_direction_dy);
}

/// exp(-|Δz - ∇z·(q - p)| / (σ_z |∇z·(q - p)| + ε)): `off_plane` is the first difference, `expected` |∇z·(q - p)|.
/// DEVIATION [Smal19 eq. 7.1]: the print has |Δz| there, so that in a slanted plane neighbours count exp(-1/σ_z)
/// along the slope and 1 across it: noise is left as streaks across the slope.
float depth_weight(float off_plane, float expected, float depth) {
    return exp(-abs(off_plane) / (sigma_depth * expected + DEPTH_EPSILON * depth));
}

/// max(0, n(p)·n(q))^σ_n.  [Smal19 eq. 7.2]
float normal_weight(vec3 a, vec3 b) {
    float cosine = min(dot(a, b), 1.0);
    return cosine > 0.0 ? pow(cosine, sigma_normal) : 0.0;
}
