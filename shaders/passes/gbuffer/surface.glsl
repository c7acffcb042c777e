// The surface at a fragment of passes/scene/triangles.vert; renderers/passes/gbuffer/draw_scene.h draws.
#include "passes/scene/drawn_material.glsl"
#include "lib/pixel_rays.glsl"

uniform vec3 eye_ws;

layout(location = 4) flat in vec3 plane_normal_ws;
layout(location = 5) flat in vec3 plane_anchor_ws;
layout(location = 6) flat in vec2 depth_range;
layout(location = 7) in vec3 way_to_previous_ws;

/// Where the pixel's ray meets the triangle's plane. Edge-on the quotient is ill-conditioned, but never leaves
/// the depths of the corners.
vec3 position_on_plane(vec3 direction) {
    vec3 origin = pixel_ray_origin(gl_FragCoord.xy);
    float depth =
        dot(plane_normal_ws, plane_anchor_ws - origin) / dot(plane_normal_ws, direction);
    return origin + clamp(depth, depth_range.x, depth_range.y) * direction;
}

bool is_seen_through(float glass, vec3 emission) { return glass > MOSTLY_GLASS && emission == vec3(0); }
