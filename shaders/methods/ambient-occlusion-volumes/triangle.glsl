// A triangle of the world as an occluder: its corners, and whether it is there where a ray meets it.
#define SCENE_POSITIONS
#define SCENE_INDICES
#define SCENE_UV0
#define SCENE_UV1
#define SCENE_TRIANGLE_MATERIALS
#include "passes/scene/scene.glsl"
#include "lib/coverage.glsl"
#include "lib/material.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };

uniform uint opaque_triangles;  // those before have no mask

mat3 corners_ws(uint triangle) {
    uvec3 corners = scene_triangle(triangle);
    return mat3(scene_position_ws(corners.x), scene_position_ws(corners.y), scene_position_ws(corners.z));
}

/// u and v are weights of the second and the third corner. In the arithmetic of the ray tracers.
bool is_there(uint triangle, float u, float v) {
    if (triangle < opaque_triangles) return true;
    uvec3 corners = scene_triangle(triangle);
    uint material = scene_triangle_materials[triangle];
    TextureSlot slot = materials[material].base_colour_slot;
    vec2 a = uv_of_slot(slot, scene_uv0[corners.x], scene_uv1[corners.x]),
         b = uv_of_slot(slot, scene_uv0[corners.y], scene_uv1[corners.y]),
         c = uv_of_slot(slot, scene_uv0[corners.z], scene_uv1[corners.z]);
    precise vec2 uv = (1.0 - u - v) * a + u * b + v * c;
    return is_covered(material, uv);
}

// Of every triangle, written by cull.comp.
// C++: ir::methods::ambient_occlusion_volumes::Occluder
struct Occluder {
    uint drawn;
    float coverage;  // mean of the mask
};
