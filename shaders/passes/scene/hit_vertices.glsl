// Corners of triangles that rays hit: renderers/passes/scene/hit_surfaces.h.
#include "lib/triangle_plane.glsl"

/// Four vec4 a vertex: position and colour (RGBA8); normal; tangent; both texture coordinates.
layout(std430) readonly buffer HitVertices { vec4 hit_vertices[]; };
layout(std430) readonly buffer HitIndices { uint hit_indices[]; };

/// Of the triangle's plane, by its winding; 0 of one without area.
vec3 hit_normal(uint triangle) {
    uvec3 first = 4u * uvec3(hit_indices[3u * triangle], hit_indices[3u * triangle + 1u],
                             hit_indices[3u * triangle + 2u]);
    return triangle_plane(hit_vertices[first.x].xyz, hit_vertices[first.y].xyz, hit_vertices[first.z].xyz).normal;
}
