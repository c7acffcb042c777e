// The orthographic views of the maps, as ir::passes::ldm::MapFrame.

/// A point P is at texel coordinates (dot(P, u.xyz) + u.w, dot(P, v.xyz) + v.w) and at depth
/// dot(P, depth.xyz) + depth.w quanta, along `direction`.
// C++: ir::passes::ldm::MapFrame
struct MapFrame {
    vec4 u, v, depth;
    vec4 step_u, step_v;  // world-space vectors that cross one texel
    vec4 direction;       // unit length; w: metres per quantum
};
layout(std430) readonly buffer LdmFrames { MapFrame ldm_frames[]; };

const float LDM_DEPTH_MARGIN = 64.0;

/// A texel's longer side in quanta of depth.
float ldm_texel_quanta(MapFrame frame) {
    return max(length(frame.step_u.xyz), length(frame.step_v.xyz)) / frame.direction.w;
}

/// Most that views let outlines of nodes rise along the map's direction, metres per texel.
float ldm_steepest_drawn_ws(MapFrame frame) { return 4.0 * ldm_texel_quanta(frame) * frame.direction.w; }

/// Metres from the scene's near end to a depth in quanta.
float ldm_metres(MapFrame frame, uint depth) {
    return (float(depth) - LDM_DEPTH_MARGIN) * frame.direction.w;
}

/// World-space centre of a texel at a depth in quanta.
vec3 ldm_texel_centre_ws(MapFrame frame, ivec2 texel, float depth) {
    return frame.step_u.xyz * (float(texel.x) + 0.5 - frame.u.w) +
           frame.step_v.xyz * (float(texel.y) + 0.5 - frame.v.w) +
           frame.direction.xyz * frame.direction.w * (depth - frame.depth.w);
}
