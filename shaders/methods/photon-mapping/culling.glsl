// Photons that can not light any pixel of the picture.

/// The camera, as photons are culled by it.
struct CullingView {
    mat4 sides;   // columns: planes through the picture's edges, unit normals inwards
    vec4 eye_ws;  // w = 1; for parallel rays the direction towards the camera, w = 0
    float reach;  // m: the longest half-axis that a kernel can have where it is not widened to texels
    float texel_reach;  // the same of kernels that are: for each m of distance, or for parallel rays m
};

/// The longest half-axis of a kernel here, m.
float reach_at(CullingView view, vec3 position_ws) {
    float scale = view.eye_ws.w > 0.0 ? distance(view.eye_ws.xyz, position_ws) : 1.0;
    return max(view.reach, scale * view.texel_reach);
}

/// Outside the frustum, widened by the reach of kernels.
/// DEVIATION [Smal19 §4.3]: there photons count as points, which darkens the picture's edges.
bool is_outside(CullingView view, vec3 position_ws) {
    vec4 distances = vec4(position_ws, 1) * view.sides;
    return min(min(distances.x, distances.y), min(distances.z, distances.w)) < -reach_at(view, position_ws);
}

/// Whether the photon lies on a side of its surface that the camera does not see: such photons are never
/// splatted. A little less is culled, so that rounding does not decide.
bool faces_away(CullingView view, vec3 position_ws, vec3 normal_ws) {
    vec3 to_eye = view.eye_ws.xyz - view.eye_ws.w * position_ws;
    return dot(normal_ws, to_eye) < -1e-5 * length(to_eye);
}
