// The world's vertices and triangles, as scene::World holds them. Each array is declared only where the
// including file asks for it:
//
//   #define SCENE_POSITIONS
//   #define SCENE_INDICES
//   #include "passes/scene/scene.glsl"
//
// Arrays of vectors are packed floats: element i of a vec3 starts at 3 i.

#ifdef SCENE_POSITIONS
layout(std430) readonly buffer ScenePositions { float scene_positions[]; };
vec3 scene_position_ws(uint vertex) {
    return vec3(scene_positions[3u * vertex], scene_positions[3u * vertex + 1u],
                scene_positions[3u * vertex + 2u]);
}
#endif

#ifdef SCENE_NORMALS
layout(std430) readonly buffer SceneNormals { float scene_normals[]; };
vec3 scene_normal_ws(uint vertex) {
    return vec3(scene_normals[3u * vertex], scene_normals[3u * vertex + 1u], scene_normals[3u * vertex + 2u]);
}
#endif

#ifdef SCENE_TANGENTS
layout(std430) readonly buffer SceneTangents { vec4 scene_tangents[]; };
#endif

#ifdef SCENE_UV0
layout(std430) readonly buffer SceneUv0 { vec2 scene_uv0[]; };
#endif

#ifdef SCENE_UV1
layout(std430) readonly buffer SceneUv1 { vec2 scene_uv1[]; };
#endif

#ifdef SCENE_COLOURS
layout(std430) readonly buffer SceneColours { uint scene_colours[]; };
vec4 scene_colour(uint vertex) {
    return unpackUnorm4x8(scene_colours[vertex]);
}
#endif

#ifdef SCENE_TO_PREVIOUS
layout(std430) readonly buffer SceneToPrevious { float scene_to_previous[]; };
/// Where the vertex was in the previous frame, from where it is; one zero stands for all where none moves.
vec3 scene_way_to_previous_ws(uint vertex) {
    uint i = 3u * min(vertex, uint(scene_to_previous.length()) / 3u - 1u);
    return vec3(scene_to_previous[i], scene_to_previous[i + 1u], scene_to_previous[i + 2u]);
}
#endif

#ifdef SCENE_INDICES
layout(std430) readonly buffer SceneIndices { uint scene_indices[]; };
uvec3 scene_triangle(uint triangle) {
    return uvec3(scene_indices[3u * triangle], scene_indices[3u * triangle + 1u],
                 scene_indices[3u * triangle + 2u]);
}
#endif

#ifdef SCENE_TRIANGLE_MATERIALS
layout(std430) readonly buffer SceneTriangleMaterials {
    uint scene_triangle_materials[];
};
#endif
