// The orthographic views of the maps, as ir::passes::ldm::MapFrame. Before including, choose the binding point
// LDM_FRAMES.

/// A point P is at texel coordinates (dot(P, u.xyz) + u.w, dot(P, v.xyz) + v.w) and at depth
/// dot(P, depth.xyz) + depth.w quanta, along `direction`.
struct MapFrame {
    vec4 u, v, depth;
    vec4 step_u, step_v;  // world-space vectors that cross one texel
    vec4 direction;       // unit length; w: metres per quantum
};
layout(std430, binding = LDM_FRAMES) readonly buffer LdmFrames { MapFrame ldm_frames[]; };

const int LDM_MAX_DEPTH = 65535;
