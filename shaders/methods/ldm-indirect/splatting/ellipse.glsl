// The ellipse that a photon's differential spans on its receiver. [Aalund15 eqs. 4, 7]
// renderers/methods/ldm-indirect/splatting/ellipses.h has the constants.
#include "lib/spaces.glsl"
#include "methods/ldm-indirect/sizes.glsl"

uniform vec3 eye_ws, view_axis_ws;
uniform float near_plane;
uniform bool perspective;
uniform float pixel_size;  // m, of a pixel at 1 m along the view axis; of a parallel view everywhere
uniform float min_axis_pixels;

struct Ellipse {
    vec3 p_ws, q_ws;  // semi-axes, m, across each other and n
    float area_part;  // |p| |q|, m²
    float height;     // of the ellipsoid along n, m
    uint mended;      // see MENDED_...
};

/// Narrower ellipses are taken for lines.
// C++: ir::methods::ldm_indirect::min_axis_ratio
const float MIN_AXIS_RATIO = 1e-6;
/// Squares of longer half-axes, in metres, would not be finite; divisors of shorter ones neither.
// C++: ir::methods::ldm_indirect::*
const float MAX_HALF_AXIS = 1e9, MIN_HALF_AXIS = 1e-9;

const uint MENDED_SHORT = 1u, MENDED_LONG = 2u, MENDED_DEGENERATE = 4u, NOT_FINITE = 8u;

/// Semi-axes of the ellipse with the conjugate radii u and v, the longer first.
void principal_axes(vec2 u, vec2 v, out vec2 direction, out float longer, out float shorter) {
    float xx = u.x * u.x + v.x * v.x, xy = u.x * u.y + v.x * v.y, yy = u.y * u.y + v.y * v.y;
    longer = sqrt(0.5 * (xx + yy) + length(vec2(0.5 * (xx - yy), xy)));
    shorter = longer > 0.0 ? abs(u.x * v.y - u.y * v.x) / longer : 0.0;
    float angle = xy == 0.0 && xx == yy ? 0.0 : 0.5 * atan(2.0 * xy, xx - yy);
    direction = vec2(cos(angle), sin(angle));
}

/// m, that a pixel spans at the photon across the view.
float pixel_at(vec3 position_ws) {
    return perspective ? pixel_size * max(dot(position_ws - eye_ws, view_axis_ws), near_plane) : pixel_size;
}

/// With half-axes u and v in the plane with normal n, scaled, and between the least and the longest.
Ellipse ellipse_of(vec3 centre_ws, vec3 n_ws, vec3 axis_u, vec3 axis_v) {
    Ellipse e;
    e.mended = 0u;
    mat3 frame = frame_around(n_ws);
    bool broken = any(isnan(axis_u)) || any(isnan(axis_v));
    vec3 u = broken ? vec3(0) : clamp(splat_size * axis_u, vec3(-MAX_HALF_AXIS), vec3(MAX_HALF_AXIS));
    vec3 v = broken ? vec3(0) : clamp(splat_size * axis_v, vec3(-MAX_HALF_AXIS), vec3(MAX_HALF_AXIS));
    vec2 direction;
    float longer, shorter;
    principal_axes((u * frame).xy, (v * frame).xy, direction, longer, shorter);
    float least = min_axis_pixels * pixel_at(centre_ws), most = max(longest_axis, least);
    if (shorter < least) e.mended |= MENDED_SHORT;
    if (longer > most) e.mended |= MENDED_LONG;
    if (!(shorter > MIN_AXIS_RATIO * longer)) e.mended |= MENDED_DEGENERATE;
    longer = clamp(longer, max(least, MIN_HALF_AXIS), most);
    shorter = clamp(shorter, max(least, MIN_AXIS_RATIO * longer), longer);
    e.p_ws = longer * (direction.x * frame[0] + direction.y * frame[1]);
    e.q_ws = shorter * (direction.x * frame[1] - direction.y * frame[0]);
    e.area_part = longer * shorter;
    // a = a' √|D_u x × D_v x| in M: the kernel ends so far from the plane
    e.height = sqrt(e.area_part) / topological_bias;
    return e;
}
