#define SCENE_POSITIONS
#define SCENE_INDICES
#define SCENE_UV0
#define SCENE_UV1
#define SCENE_TRIANGLE_MATERIALS
#include "passes/scene/scene.glsl"
#include "lib/material.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };

uniform mat4 clip_from_world;
uniform vec3 origin_ws, depth_axis_ws;

layout(location = 0) out float depth;  // along the map's axis, 1 at its far distance
#if MASKED
layout(location = 1) out vec2 uv;
layout(location = 2) flat out uint material;
#endif

void main() {
    uint vertex = scene_indices[gl_VertexID];
    vec3 position_ws = scene_position_ws(vertex);
    gl_Position = clip_from_world * vec4(position_ws, 1);
    depth = dot(position_ws - origin_ws, depth_axis_ws);
#if MASKED
    material = scene_triangle_materials[gl_VertexID / 3];
    uv = uv_of_slot(materials[material].base_colour_slot, scene_uv0[vertex], scene_uv1[vertex]);
#endif
}
