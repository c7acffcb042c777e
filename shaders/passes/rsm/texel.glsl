// What both draws of an RSM share: where the texel's ray meets the triangle.
#include "passes/scene/drawn_material.glsl"

uniform vec3 eye_ws, view_right_ws, view_up_ws, view_axis_ws;
uniform float perspective;  // 1 or 0
uniform float far, resolution;
uniform vec3 cone_axis_ws;  // of a spot
uniform float cone_cosine;  // of its outer half-angle; below -1: the light has no cone

layout(location = 4) flat in vec3 plane_normal_ws;
layout(location = 5) flat in vec3 plane_anchor_ws;
layout(location = 6) flat in vec2 depth_range;

/// From the light through the texel's centre; advances by 1 along the map's axis.
vec3 texel_direction() {
    vec2 ndc = (gl_FragCoord.xy / resolution * 2.0 - 1.0) * vec2(1, -1);
    return view_axis_ws + perspective * (ndc.x * view_right_ws + ndc.y * view_up_ws);
}

/// Where a spot does not shine its map stays empty.
bool is_outside_cone() {
    vec3 direction = texel_direction();
    return dot(direction, cone_axis_ws) < cone_cosine * length(direction);
}

/// Along the map's axis as a fraction of its far distance. Edge-on the quotient is ill-conditioned, but never
/// leaves the depths of the corners.
float texel_depth() {
    vec2 ndc = (gl_FragCoord.xy / resolution * 2.0 - 1.0) * vec2(1, -1);
    vec3 lateral_ws = (1.0 - perspective) * (ndc.x * view_right_ws + ndc.y * view_up_ws);
    precise float depth = dot(plane_normal_ws, plane_anchor_ws - (eye_ws + lateral_ws)) /
                          dot(plane_normal_ws, texel_direction());
    return clamp(depth, depth_range.x, depth_range.y) / far;
}
