// What a photon lights: an ellipsoid around the ellipse that its differential spans.  [Aalund15 eqs. 4-7]
// renderers/methods/ldm-indirect/splatting/stored.h has the constants.
#include "lib/constants.glsl"
#include "lib/spaces.glsl"
#include "methods/ldm-indirect/records.glsl"

layout(std430) readonly buffer Stored { uint stored; };
/// Directions of the maps (w 0), then places (w 1) or directions of travel (w 0) of the lights.
layout(std430) readonly buffer Arrivals { vec4 arrivals[]; };

uniform vec3 eye_ws, view_axis_ws;
uniform float near_plane;
uniform bool perspective;
uniform float pixel_size;  // m, of a pixel at 1 m along the view axis; of a parallel view everywhere
uniform float splat_size, topological_bias, min_axis_pixels, longest_axis;
uniform uint map_count, light_count;
uniform bool count_indirect, count_direct;

struct Footprint {
    bool counts;        // false: nothing to splat
    uint mended;        // see MENDED_...
    vec3 centre_ws, n_ws;
    vec3 p_ws, q_ws;    // semi-axes of the ellipse, m, across each other and n
    float height;       // of the ellipsoid along n, m
    vec3 irradiance;    // E_p, W/m²
    vec3 to_source_ws;  // where the light came from
};

/// Narrower ellipses are taken for lines.
const float min_ratio = 1e-6;

const uint MENDED_SHORT = 1u, MENDED_LONG = 2u, MENDED_DEGENERATE = 4u, NOT_FINITE = 8u;

bool not_finite(vec3 v) { return any(isnan(v)) || any(isinf(v)); }

bool is_asked_for(Photon photon) {
    return (photon.leg & LEG_DIRECT) != 0u ? count_direct : count_indirect;
}

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

vec3 source_direction(Photon photon) {
    uint item = photon.leg & LEG_MAP;
    if ((photon.leg & LEG_DIRECT) == 0u) {
        vec3 along = arrivals[min(item, map_count - 1u)].xyz;
        return (photon.leg & LEG_ALONG) != 0u ? -along : along;
    }
    if (light_count == 0u) return vec3(0);
    vec4 light = arrivals[map_count + min(photon.leg >> LEG_LIGHT_SHIFT, light_count - 1u)];
    return light.w > 0.5 ? normalize(light.xyz - photon.centre_ws) : -light.xyz;
}

/// The photon's footprint with its axes in the receiver's plane, scaled, and between the least and the longest.
/// The area follows, so that the flux stays.  [Aalund15 eq. 4, with A_p = π |p| |q|]
Footprint footprint_of(Photon photon) {
    Footprint f;
    f.mended = 0u;
    f.counts = is_asked_for(photon);
    if (not_finite(photon.centre_ws) || not_finite(photon.flux)) {
        f.counts = false;
        f.mended = NOT_FINITE;
    }
    if (!f.counts) return f;
    f.centre_ws = photon.centre_ws;
    f.n_ws = unpacked_direction(photon.normal);
    mat3 frame = frame_around(f.n_ws);
    bool broken = any(isnan(photon.axis_u)) || any(isnan(photon.axis_v));
    // squares of larger numbers would not be finite
    vec3 u = broken ? vec3(0) : clamp(splat_size * photon.axis_u, vec3(-1e9), vec3(1e9));
    vec3 v = broken ? vec3(0) : clamp(splat_size * photon.axis_v, vec3(-1e9), vec3(1e9));
    vec2 direction;
    float longer, shorter;
    principal_axes((u * frame).xy, (v * frame).xy, direction, longer, shorter);
    float least = min_axis_pixels * pixel_at(f.centre_ws), most = max(longest_axis, least);
    if (shorter < least) f.mended |= MENDED_SHORT;
    if (longer > most) f.mended |= MENDED_LONG;
    if (!(shorter > min_ratio * longer)) f.mended |= MENDED_DEGENERATE;
    longer = clamp(longer, max(least, 1e-9), most);
    shorter = clamp(shorter, max(least, min_ratio * longer), longer);
    f.p_ws = longer * (direction.x * frame[0] + direction.y * frame[1]);
    f.q_ws = shorter * (direction.x * frame[1] - direction.y * frame[0]);
    // a = a' √|D_u x × D_v x| in M: the kernel ends so far from the plane
    f.height = sqrt(longer * shorter) / topological_bias;
    f.irradiance = photon.flux / (PI * longer * shorter);
    f.to_source_ws = source_direction(photon);
    return f;
}

/// [Aalund15 eq. 6]
float silverman(float squared_length) {
    float below = max(1.0 - squared_length, 0.0);
    return 3.0 / PI * below * below;
}
