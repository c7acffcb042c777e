// Where a pixel's rays start.

uniform float min_offset, offset_scale;  // renderers/passes/raytracing/ray_offset.h

float ray_offset(vec3 position_ws) {
    vec3 size = abs(position_ws);
    return min_offset + offset_scale * max(size.x, max(size.y, size.z));
}

/// Away from the surface, so that it and its neighbours in one plane lie below. [Waechter19]
vec3 offset_origin(vec3 position_ws, vec3 geometric_normal) {
    return position_ws + ray_offset(position_ws) * geometric_normal;
}
