// One vertex a photon; E_p = Φ_p / A_p. [Aalund15 §4.2, eq. 4]
// DEVIATION [Aalund15 §4.2]: the buffer that tracing left is read as a storage buffer, not bound again as a vertex
// array, so that all ways of splatting read photons alike. The picture is the same.
#include "methods/ldm-indirect/splatting/footprint.glsl"

layout(std430) readonly buffer Photons { Photon photons[]; };

layout(location = 0) flat out vec4 centre;  // w: 0 for photons that are not drawn
layout(location = 1) flat out vec4 p_axis;  // w: height
layout(location = 2) flat out vec3 q_axis;
layout(location = 3) flat out vec3 normal;
layout(location = 4) flat out vec3 irradiance;
layout(location = 5) flat out vec3 to_source;
layout(location = 6) flat out vec2 beam_of;  // distance, map

void main() {
    Footprint f = footprint_of(photons[gl_VertexID]);
    gl_Position = vec4(0, 0, 0, 1);
    centre = vec4(0);
    if (!f.counts) return;
    centre = vec4(f.centre_ws, 1);
    p_axis = vec4(f.p_ws, f.height);
    q_axis = f.q_ws;
    normal = f.n_ws;
    irradiance = f.irradiance;
    to_source = f.to_source_ws;
    beam_of = vec2(f.distance, float(f.map));
}
