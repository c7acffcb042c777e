// Where alpha masks have holes, there are no surfels.
#include "lib/coverage.glsl"
#include "lib/material.glsl"
#define SCENE_UV0
#define SCENE_UV1
#define SCENE_INDICES
#define SCENE_TRIANGLE_MATERIALS
#include "passes/scene/scene.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };

/// Whether the triangle's alpha mask has a surface at this place, packed as surfels have it.
bool is_surface_there(uint triangle, uint barycentrics) {
    uint material = scene_triangle_materials[triangle];
    if (opacity[material].width == 0) return true;
    uvec3 corners = scene_triangle(triangle);
    vec2 w = unpackUnorm2x16(barycentrics);
    vec3 weights = vec3(1.0 - w.x - w.y, w);
    vec2 uv0 = weights.x * scene_uv0[corners.x] + weights.y * scene_uv0[corners.y] + weights.z * scene_uv0[corners.z];
    vec2 uv1 = weights.x * scene_uv1[corners.x] + weights.y * scene_uv1[corners.y] + weights.z * scene_uv1[corners.z];
    return is_covered(material, uv_of_slot(materials[material].base_colour_slot, uv0, uv1));
}
