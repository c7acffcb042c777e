// The kernel of a footprint at a place. [Aalund15 eqs. 5-7]
#include "methods/ldm-indirect/splatting/footprint.glsl"

struct Kernel {
    vec3 centre_ws, row_p, row_q, row_n;  // rows of M
    vec3 peak;                            // E_p π, W/m²
    vec3 to_source_ws;
    float per_cosine;                     // 1 over that to the light on the photon's own plane
    float distance;                       // of a beam, see Footprint
    uint map;
};

/// The rows of M for axes that are the ellipse's own: D_u/2 = p, D_v/2 = q, n are orthogonal.
Kernel kernel_of(Footprint f) {
    return Kernel(f.centre_ws, f.p_ws / dot(f.p_ws, f.p_ws), f.q_ws / dot(f.q_ws, f.q_ws), f.n_ws / f.height,
                  PI * f.irradiance, f.to_source_ws, per_cosine(f), f.distance, f.map);
}

/// What it adds to the sum of directions where it adds this irradiance.
vec3 direction_of(Kernel k, vec3 irradiance) { return dot(irradiance, vec3(1)) * k.to_source_ws; }

/// m, along a beam from the sender to a place.
float along_beam(Kernel k, vec3 position_ws) { return k.distance - dot(position_ws - k.centre_ws, k.to_source_ws); }

/// Of the way from the sender that a pixel has to see: nearer to the sender the photon itself found the way clear.
// C++: ir::methods::ldm_indirect::part_looked
const float PART_LOOKED = 0.25;

/// m, that a place has to see along a beam to be lit.
float min_look(Kernel k, vec3 position_ws) {
    float way = along_beam(k, position_ws);
    return max(PART_LOOKED * way, way - (1.0 - PART_LOOKED) * k.distance);
}

/// ‖M (x - x_p)‖²; of a beam across it, and 1 before it begins and behind its end.
float squared_length(Kernel k, vec3 position_ws) {
    vec3 d = position_ws - k.centre_ws;
    vec3 l = vec3(dot(k.row_p, d), dot(k.row_q, d), k.distance > 0.0 ? 0.0 : dot(k.row_n, d));
    if (k.distance > 0.0) {
        float way = along_beam(k, position_ws);
        if (way <= BEAM_BEGINS * k.distance || way >= BEAM_ENDS * k.distance) return 1.0;
    }
    return dot(l, l);
}

/// What it adds to the irradiance at a place with this geometric normal, W/m². [Aalund15 eq. 5]
/// DEVIATION [Aalund15 eq. 5]: see turned().
/// DEVIATION [Aalund15 eq. 5]: f_s is left out here and applied to the sum, as it is the same for all photons
/// of a pixel: texture detail survives, and nothing but rounding changes. Where it would be 0, as the surface
/// faces away from the light, nothing is added; the paper names only a against light on wrong surfaces. Without
/// that the Cornell box is 2 % brighter, all of it light from below surfaces.
bool add_kernel(Kernel k, vec3 position_ws, vec3 normal_ws, out vec3 irradiance) {
    float squared = squared_length(k, position_ws);
    float facing = dot(normal_ws, k.to_source_ws);
    irradiance = k.peak * (silverman(squared) * turned(facing, k.per_cosine));
    return squared < 1.0 && facing > 0.0;
}
