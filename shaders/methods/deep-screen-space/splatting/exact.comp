// Level 0 by the scene's triangles: each ray as far as the first shell of a surfel at the pixel reaches. GLASS: glass
// lets rays through.
#include "methods/deep-screen-space/records.glsl"
#if GLASS
#include "passes/scene/hit_materials.glsl"
#include "passes/scene/hit_triangle.glsl"
#endif
#include "methods/deep-screen-space/splatting/glass.glsl"
#include "methods/deep-screen-space/splatting/influence.glsl"
#include "methods/deep-screen-space/surfels/ideal.glsl"
#include "passes/bounce/tiles.glsl"
#include "passes/raytracing/bvh.glsl"
#include "passes/raytracing/ray_offset.glsl"

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_geometric_normal;
uniform sampler2DArray directions;
layout(rg32ui) uniform writeonly uimage2DArray exact_image;

uniform float max_distance;  // m; 0: no limit

float exact_reach(vec3 x_ws) {
    float reach = shell_of(sqrt(ideal_area(x_ws) / PI), 0).outer;
    return max_distance > 0.0 ? min(reach, max_distance) : reach;
}

RayHit exact_hit_of(vec3 origin, vec3 direction_ws, float reach) {
    RayHit hit;
    find_first_hit(Ray(origin, reach, direction_ws, 0.0), hit);
#if GLASS
    for (int pane = 0; pane < MAX_PANES && is_hit(hit); ++pane) {
        if (!passes_glass(hit.triangle, dot(hit_normal(hit.triangle), direction_ws), direction_ws)) break;
        float from = hit.distance + ray_offset(origin + hit.distance * direction_ws);
        find_first_hit(Ray(origin + from * direction_ws, reach - from, direction_ws, 0.0), hit);
        hit.distance += from;
    }
#endif
    return hit;
}

void main() {
    ivec2 pixel = tile_pixel();
    ivec3 size = imageSize(exact_image);
    if (any(greaterThanEqual(pixel, size.xy))) return;
    vec4 x = texelFetch(gbuffer_position, pixel, 0);
    vec3 normal_ws = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    float reach = exact_reach(x.xyz);
    for (int i = 0; i < size.z; ++i) {
        vec3 direction = texelFetch(directions, ivec3(pixel, i), 0).xyz;
        RayHit hit = no_hit();
        if (x.w != 0.0 && direction != vec3(0))
            hit = exact_hit_of(offset_origin(x.xyz, normal_ws), direction, reach);
        uvec2 found = is_hit(hit) ? uvec2(1u + hit.triangle, floatBitsToUint(hit.distance))
                                  : uvec2(0u, floatBitsToUint(reach));
        imageStore(exact_image, ivec3(pixel, i), found.xyxx);
    }
}
