// The triangle that a ray hit (renderers/passes/scene/hit_surfaces.h).
#include "lib/triangle_plane.glsl"

/// Four vec4 a vertex: position and colour (RGBA8); normal; tangent; both texture coordinates.
layout(std430) readonly buffer HitVertices { vec4 hit_vertices[]; };
layout(std430) readonly buffer HitIndices { uint hit_indices[]; };

/// The first vec4 of each corner.
uvec3 hit_corners(uint triangle) {
    return 4u * uvec3(hit_indices[3u * triangle], hit_indices[3u * triangle + 1u], hit_indices[3u * triangle + 2u]);
}

/// Unit length, on the side of its winding; 0 where the triangle has no area.
vec3 hit_normal(uint triangle) {
    uvec3 first = hit_corners(triangle);
    return triangle_plane(hit_vertices[first.x].xyz, hit_vertices[first.y].xyz, hit_vertices[first.z].xyz).normal;
}

/// The same on the side that a ray along `direction_ws` came from.
vec3 hit_normal(uint triangle, vec3 direction_ws) {
    vec3 normal = hit_normal(triangle);
    return dot(normal, direction_ws) > 0.0 ? -normal : normal;
}
