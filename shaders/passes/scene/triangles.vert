// Fetches one corner of a triangle for a view; every corner also brings the triangle's plane. What it reads is
// declared by renderers/passes/scene/draw_triangles.h.

#define SCENE_POSITIONS
#define SCENE_NORMALS
#define SCENE_TANGENTS
#define SCENE_UV0
#define SCENE_UV1
#define SCENE_COLOURS
#define SCENE_TO_PREVIOUS
#define SCENE_INDICES
#include "passes/scene/scene.glsl"
#include "lib/material.glsl"
#include "lib/triangle_plane.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };

uniform int material_index;
uniform mat4 clip_from_world;
uniform vec3 eye_ws, view_axis_ws;

layout(location = 0) out vec3 normal_ws;
layout(location = 1) out vec4 tangent_ws;
layout(location = 2) out vec4 uv01;
layout(location = 3) out vec4 colour;
layout(location = 4) flat out vec3 plane_normal_ws;
layout(location = 5) flat out vec3 plane_anchor_ws;
layout(location = 6) flat out vec2 depth_range;  // nearest and farthest corner along the view axis, m
layout(location = 7) out vec3 way_to_previous_ws;
// Coordinates of the texture slots. They are made here because pixels beside the triangle, from which the
// differences between neighbours come, may not be able to read buffers.
layout(location = 8) out vec2 base_colour_uv;
layout(location = 9) out vec2 metallic_roughness_uv;
layout(location = 10) out vec2 normal_uv;
layout(location = 11) out vec2 emission_uv;
layout(location = 12) out vec2 transmission_uv;

void main() {
    uvec3 corners = scene_triangle(uint(gl_VertexID) / 3u);
    vec3 a = scene_position_ws(corners.x), b = scene_position_ws(corners.y), c = scene_position_ws(corners.z);
    TrianglePlane plane = triangle_plane(a, b, c);
    plane_normal_ws = plane.normal;
    plane_anchor_ws = plane.anchor;
    vec3 depths = vec3(dot(a - eye_ws, view_axis_ws), dot(b - eye_ws, view_axis_ws), dot(c - eye_ws, view_axis_ws));
    depth_range = vec2(min(depths.x, min(depths.y, depths.z)), max(depths.x, max(depths.y, depths.z)));

    uint corner = uint(gl_VertexID) % 3u;
    uint vertex = corners[corner];
    normal_ws = scene_normal_ws(vertex);
    tangent_ws = scene_tangents[vertex];
    uv01 = vec4(scene_uv0[vertex], scene_uv1[vertex]);
    Material material = materials[material_index];
    base_colour_uv = slot_uv(material.base_colour_slot, uv01);
    metallic_roughness_uv = slot_uv(material.metallic_roughness_slot, uv01);
    normal_uv = slot_uv(material.normal_slot, uv01);
    emission_uv = slot_uv(material.emission_slot, uv01);
    transmission_uv = slot_uv(material.transmission_slot, uv01);
    colour = scene_colour(vertex);
    way_to_previous_ws = scene_way_to_previous_ws(vertex);
    gl_Position = clip_from_world * vec4(corner == 0u ? a : corner == 1u ? b : c, 1);
}
