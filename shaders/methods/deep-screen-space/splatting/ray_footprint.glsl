// What of a sender one ray stands for. Include passes/scene/hit_triangle.glsl before it.

uniform float highlight_share;  // of the solid angle 1 / density; 0: rays stand for points

/// Largest turn of vertex normals along an edge of the triangle, rad/m.
float triangle_curvature(uint triangle) {
    uvec3 first = hit_corners(triangle);
    float largest = 0.0;
    for (uint i = 0u; i < 3u; ++i) {
        uint a = first[i], b = first[(i + 1u) % 3u];
        vec3 turn = hit_vertices[b + 1u].xyz - hit_vertices[a + 1u].xyz, way = hit_vertices[b].xyz - hit_vertices[a].xyz;
        largest = max(largest, length(turn) / max(length(way), 1e-6));
    }
    return largest;
}

/// Variance, along each axis, of the slopes of half vectors over the disc of this solid angle around the ray: those of
/// the directions to its points, halved, and of the normals there, if the surface is curved as the triangle is.
/// DEVIATION [Nalbach15 §3.2]: a ray shows what its one direction has. A highlight that few rays meet is a bright
/// blotch. Averaged over what lies between rays it is dimmer and wider, with the same light. [Kaplanyan13]
float ray_slope_variance(uint triangle, float distance_m, float density) {
    if (highlight_share == 0.0) return 0.0;
    float radius = sqrt(highlight_share / (PI * density));  // at 1 m
    float turn = radius * distance_m * triangle_curvature(triangle);
    return radius * radius / 16.0 + turn * turn / 4.0;
}
