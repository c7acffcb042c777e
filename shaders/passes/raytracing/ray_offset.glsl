/// How far a ray's origin lies off the surface that it starts on, m.
float ray_offset(vec3 position_ws) {
    vec3 size = abs(position_ws);
    // min_ray_offset_m and relative_ray_offset of renderers/passes/raytracing/ray_offset.h
    return 1e-6 + 32.0 / 8388608.0 * max(size.x, max(size.y, size.z));
}

/// Origin of rays that leave the side to which the unit geometric normal points.
vec3 offset_origin(vec3 position_ws, vec3 geometric_normal_ws) {
    return position_ws + ray_offset(position_ws) * geometric_normal_ws;
}
