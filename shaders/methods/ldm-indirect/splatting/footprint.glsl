// What a photon lights: an ellipsoid around the ellipse that its differential spans.  [Aalund15 eqs. 4-7]
// renderers/methods/ldm-indirect/splatting/stored.h has the constants.
#include "lib/constants.glsl"
#include "methods/ldm-indirect/beam.glsl"
#include "methods/ldm-indirect/records.glsl"
#include "methods/ldm-indirect/splatting/ellipse.glsl"

#ifndef NOTHING_STORED
layout(std430) readonly buffer Stored { uint stored; };
#endif
/// Directions of the maps (w 0), then places (w 1) or directions of travel (w 0) of the lights.
layout(std430) readonly buffer Arrivals { vec4 arrivals[]; };

uniform uint map_count, light_count;
uniform bool count_indirect, count_direct;
uniform bool turns_receivers;  // see turned()
uniform bool clips;            // see Footprint::distance

struct Footprint {
    bool counts;        // false: nothing to splat
    uint mended;        // see MENDED_...
    vec3 centre_ws, n_ws;
    vec3 p_ws, q_ws;    // semi-axes of the ellipse, m, across each other and n
    float height;       // of the ellipsoid along n, m
    vec3 irradiance;    // E_p, W/m²
    vec3 to_source_ws;  // where the light came from
    /// m, from the sender: the footprint is a beam, with its ellipse across it, and lights what it meets between
    /// BEAM_BEGINS and BEAM_ENDS times so far from the sender. 0: it is an ellipsoid.
    float distance;
    uint map;
};

bool not_finite(vec3 v) { return any(isnan(v)) || any(isinf(v)); }

bool is_requested(Photon photon) {
    return (photon.leg & LEG_DIRECT) != 0u ? count_direct : count_indirect;
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
/// The area follows, so that the flux stays; what lies beyond the
/// surface comes to what does not.  [Aalund15 eq. 4, with A_p = π |p| |q|]
Footprint footprint_of(Photon photon) {
    Footprint f;
    f.mended = 0u;
    f.counts = is_requested(photon);
    if (not_finite(photon.centre_ws) || not_finite(photon.flux)) {
        f.counts = false;
        f.mended = NOT_FINITE;
    }
    if (!f.counts) return f;
    f.centre_ws = photon.centre_ws;
    f.to_source_ws = source_direction(photon);
    f.map = photon.leg & LEG_MAP;
    f.distance = clips && (photon.leg & LEG_DIRECT) == 0u ? photon.distance : 0.0;
    f.n_ws = f.distance > 0.0 ? f.to_source_ws : unpacked_direction(photon.normal);
    Ellipse e = ellipse_of(f.centre_ws, f.n_ws, photon.axis_u, photon.axis_v);
    f.mended = e.mended;
    f.p_ws = e.p_ws;
    f.q_ws = e.q_ws;
    f.height = e.height;
    f.irradiance = photon.flux / (PI * e.area_part * part_on_surface(photon));
    return f;
}

/// Photons that come steeper are taken as if they came along the normal; those that come flatter, as if at the least.
// C++: ir::methods::ldm_indirect::*
const float MAX_TURNED_COSINE = 0.9999, MIN_TURNED_COSINE = 1e-3;

/// 0: as printed. So it is across the ray, too, where a photon's surface is not known.
float per_cosine(Footprint f) {
    if (f.distance > 0.0) return 1.0;  // its plane lies across the beam
    float cosine = dot(f.n_ws, f.to_source_ws);
    return turns_receivers && cosine < MAX_TURNED_COSINE ? 1.0 / max(cosine, MIN_TURNED_COSINE) : 0.0;
}

/// Most that a surface may get more than the photon's plane because it faces the light more.
// C++: ir::methods::ldm_indirect::max_turned
const float MAX_TURNED = 4.0;

/// What a surface gets of E_p that is turned against the photon's plane: its cosine to the light over the plane's.
/// DEVIATION [Aalund15 eq. 5]: print has the plane's cosine for all surfaces in the kernel. With each surface's own
/// the kernel gives as much light as the beam brings, whatever lies in it.
float turned(float facing, float per_cosine) {
    return per_cosine > 0.0 ? min(facing * per_cosine, MAX_TURNED) : 1.0;
}

/// [Aalund15 eq. 6]
float silverman(float squared_length) {
    float below = max(1.0 - squared_length, 0.0);
    return 3.0 / PI * below * below;
}
