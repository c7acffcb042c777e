// Emissive triangles, which shine on both sides: passes::TriangleLights (renderers/passes/lights/triangle_lights.h).
#include "lib/floats.glsl"
#include "passes/lights/sources.glsl"
#include "passes/scene/texels.glsl"

vec2 uv_at(vec2 uv[3], vec2 at) { return (1.0 - at.x - at.y) * uv[0] + at.x * uv[1] + at.y * uv[2]; }

vec3 emission_at(EmissiveTriangle t, vec2 at) {
    return t.texture < 0 ? t.emission : t.emission * texture_at(t.texture, uv_at(t.uv, at));
}

/// Density per solid angle with which the point is chosen: distance² / (cos * area).
float pdf_on_triangle(EmissiveTriangle t, vec3 position_ws, vec2 at) {
    vec3 offset = t.corner_ws + at.x * t.edge_u_ws + at.y * t.edge_v_ws - position_ws;
    float squared = dot(offset, offset);
    float twice = abs(dot(offset, cross(t.edge_u_ws, t.edge_v_ws)));
    float density = 2.0 * squared * sqrt(squared) / twice;
    return is_finite(density) ? density : 0.0;
}
