// Alpha masks in maps. Include triangle.glsl first.
#include "lib/coverage.glsl"
#include "lib/material.glsl"

layout(std430) readonly buffer Materials { Material ldm_materials[]; };

bool is_covered(uint triangle, uvec3 corners, vec3 weights) {
    uint material = scene_triangle_materials[triangle];
    vec2 uv0 = mat3x2(scene_uv0[corners.x], scene_uv0[corners.y], scene_uv0[corners.z]) * weights;
    vec2 uv1 = mat3x2(scene_uv1[corners.x], scene_uv1[corners.y], scene_uv1[corners.z]) * weights;
    return is_covered(material, uv_of_slot(ldm_materials[material].base_colour_slot, uv0, uv1));
}
