// The ray of a pixel's sample against one triangle.
#include "passes/raytracing/triangle_hit.glsl"

/// Distance in metres to where the ray meets the triangle; negative where it does not, or from `reach` on.
float hit_distance(uint triangle, mat3 corners, vec3 origin, vec3 direction, float reach) {
    float distance, u, v;
    if (!hits_triangle(corners[0] - origin, corners[1] - origin, corners[2] - origin, direction, distance, u, v))
        return -1.0;
    if (!(distance > 0.0 && distance < reach) || !is_there(triangle, u, v)) return -1.0;
    return distance;
}
