// Highlights as wide as what a ray stands for: renderers/passes/scattering/highlights.h. A ray shows what its one
// direction has, and a highlight that few rays meet is a bright dot. Averaged over what lies between rays it is dimmer
// and wider, with the same light.  [Kaplanyan13]
#include "lib/brdf.glsl"
#include "lib/constants.glsl"
#include "passes/scene/hit_triangle.glsl"

/// Largest turn of vertex normals along an edge of the triangle, rad/m.
float triangle_curvature(uint triangle) {
    uvec3 first = hit_corners(triangle);
    float largest = 0.0;
    for (uint i = 0u; i < 3u; ++i) {
        uint a = first[i], b = first[(i + 1u) % 3u];
        float turn = distance(hit_vertices[a + 1u].xyz, hit_vertices[b + 1u].xyz);
        largest = max(largest, turn / max(distance(hit_vertices[a].xyz, hit_vertices[b].xyz), 1e-6));
    }
    return largest;
}

/// Variance, along each axis, of the slopes of half vectors over the disc of this solid angle (sr) around a ray: those
/// of the directions to its points, halved, and of the normals there, if the surface is curved as the triangle is.
float slope_variance(uint triangle, float distance_m, float solid_angle) {
    float radius = sqrt(solid_angle / PI);  // at 1 m
    float turn = radius * distance_m * triangle_curvature(triangle);
    return radius * radius / 16.0 + turn * turn / 4.0;
}

/// Roughness of a highlight that is the mean over half vectors whose slopes vary by `variance` along each axis, added
/// to the α²/2 of the microfacets'.
float widened_roughness(float roughness, float variance) {
    float alpha = roughness * roughness;
    return min(sqrt(sqrt(alpha * alpha + 2.0 * variance)), 1.0);
}

/// How much more a highlight of its own roughness reflects than the widened one, which loses light between
/// microfacets. `cosine`: to the ray; the fit is wrong at grazing angles.
float widened_gain(float own, float widened, float cosine) {
    float bounded = max(cosine, 0.1);
    return directional_albedo(vec3(1), own, bounded).x / directional_albedo(vec3(1), widened, bounded).x;
}
