// What of a photon's kernel lies beyond its surface, where nothing receives it, by the entries of the map that the
// photon flew through. Include passes/ldm/entry_plane.glsl and records.glsl first.
// On the host: tracing/host/overhang.h.
// DEVIATION [Aalund15 §3.4]: the paper loses it. In the Cornell box with a lamp that is 7 to 10 % of the light if
// kernels are a quarter as thick as wide.
#include "methods/ldm-indirect/splatting/ellipse.glsl"

/// Places of equal weight in Silverman's kernel, on a spiral.
// C++: ir::methods::ldm_indirect::overhang_samples
const int OVERHANG_SAMPLES = 16;
// C++: ir::methods::ldm_indirect::golden_angle
const float GOLDEN_ANGLE = 2.3999632;

/// By which the spiral of a photon is turned, in golden angles. At one angle its places tell the part beyond a straight
/// edge wrong by up to 0.1, and unturned the photons of one direction would all err alike.
uint spiral_turn(Photon photon) { return (photon.source + (photon.leg & LEG_MAP)) % 256u; }

/// In 1/64, as LEG_BEYOND says.
uint part_beyond(Photon photon, MapFrame frame, uint map, int resolution) {
    vec3 n = unpacked_direction(photon.normal);
    Ellipse e = ellipse_of(photon.centre_ws, n, photon.axis_u, photon.axis_v);
    // What a quantum is along n, in heights of the kernel.
    float per_quantum = max(abs(dot(n, frame.direction.xyz)) * frame.direction.w / e.height, 1e-9);
    vec2 slope = ldm_slope_of(frame, n);
    float on_surface = 0.0;
    uint turn = spiral_turn(photon);
    for (int i = 0; i < OVERHANG_SAMPLES; ++i) {
        float squared = 1.0 - pow(1.0 - (float(i) + 0.5) / float(OVERHANG_SAMPLES), 1.0 / 3.0);
        float angle = float(uint(i) + turn) * GOLDEN_ANGLE, radius = sqrt(squared);
        vec3 at = ldm_project(frame, photon.centre_ws + radius * (cos(angle) * e.p_ws + sin(angle) * e.q_ws));
        ivec2 texel = ivec2(floor(at.xy));
        float depth = at.z + dot(slope, vec2(texel) + 0.5 - at.xy), entry;
        if (!ldm_nearest(map, texel, resolution, depth, sqrt(1.0 - squared) / per_quantum, entry)) continue;
        float off = (entry - depth) * per_quantum, left = (1.0 - squared - off * off) / (1.0 - squared);
        on_surface += left * left;
    }
    return min(uint(64.0 * (1.0 - on_surface / float(OVERHANG_SAMPLES)) + 0.5), MAX_BEYOND);
}
