// Where rays of a pixel through the scene's triangles start.

/// This part of its coordinates above the surface: renderers/passes/raytracing/ray_offset.h.
const float SPLAT_RAY_OFFSET = 4e-6;

vec3 splat_ray_origin(vec3 x_ws, vec3 geometric_normal_ws) {
    vec3 size = abs(x_ws);
    return x_ws + (1e-6 + SPLAT_RAY_OFFSET * max(size.x, max(size.y, size.z))) * geometric_normal_ws;
}
