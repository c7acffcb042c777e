// Writes what is visible at the pixel's centre; with PEELED what lies behind the layer before.

#include "passes/gbuffer/surface.glsl"

uniform int see_through;  // 1: glass is left out
uniform vec2 size_px;
uniform mat4 previous_clip_from_world;
uniform vec4 previous_depth_row;  // distance along the previous view's axis of a point in world space

layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;
layout(location = 2) out vec4 out_geometric_normal;
layout(location = 3) out vec4 out_albedo;
layout(location = 4) out vec4 out_material;
layout(location = 5) out vec4 out_emission;
layout(location = 6) out vec2 out_velocity;
layout(location = 7) out float out_valid;

/// Where the point was in the previous frame.
vec4 previous_position_ws(vec3 position_ws) { return vec4(position_ws + way_to_previous_ws, 1); }

/// Pixels that the point moved since the previous frame; 0 where it was behind the camera.
vec2 velocity_px(vec3 position_ws) {
    vec4 before = previous_clip_from_world * previous_position_ws(position_ws);
    if (before.w <= 0.0) return vec2(0);
    vec2 before_px = (before.xy / before.w * vec2(0.5, -0.5) + 0.5) * size_px;
    return gl_FragCoord.xy - before_px;
}

#ifdef PEELED
uniform sampler2D nearer_position;

/// A surface belongs to the next layer if it is farther than the one before by more than this factor.
// C++: ir::passes::peeled_beyond
const float PEELED_BEYOND = 1.00001;

bool is_peeled_off(vec3 position_ws) {
    vec4 nearer = texelFetch(nearer_position, ivec2(gl_FragCoord.xy), 0);
    vec3 origin = pixel_ray_origin(gl_FragCoord.xy);
    return nearer.w <= 0.0 || distance(position_ws, origin) <= PEELED_BEYOND * distance(nearer.xyz, origin);
}
#endif

void main() {
    Material material = materials[material_index];
    vec3 direction = pixel_ray_direction(gl_FragCoord.xy);
    vec3 geometric_normal_ws = plane_normal_ws;
#ifndef PEELED
    if (dot(plane_normal_ws, direction) > 0.0) geometric_normal_ws = -plane_normal_ws;
#endif
    vec3 position_ws = position_on_plane(direction);
    vec2 reflection = metallic_roughness(material);
    float glass = glass_fraction(material, reflection.x);
    vec3 shining = emission(material);
    bool unlit = (material.flags & MATERIAL_UNLIT) != 0u;

    out_position = vec4(position_ws, distance(position_ws, eye_ws));
    out_normal = vec4(shading_normal(material, geometric_normal_ws), 0);
    out_geometric_normal =
        vec4(geometric_normal_ws, dot(previous_depth_row, previous_position_ws(position_ws)));
    out_albedo = vec4(base_colour(material).rgb, transmission(material));
    out_material = vec4(reflection, unlit ? 1 : 0, material_index);
    out_emission = vec4(shining, 0);
    out_velocity = velocity_px(position_ws);
    out_valid = glass > MOSTLY_GLASS ? 0.0 : 1.0;
    bool is_left_out = see_through != 0 && is_seen_through(glass, shining);
#ifdef PEELED
    is_left_out = is_left_out || is_peeled_off(position_ws);
#endif
    if (is_left_out || has_hole_here()) discard;
}
