// The triangles in whose volumes the picked pixel's point lies: first which, then what each of them does.
layout(local_size_x = 64) in;
#define LIGHT 0
#include "lib/constants.glsl"
#include "lib/floats.glsl"
#include "methods/ambient-occlusion-volumes/triangle.glsl"
#include "methods/ambient-occlusion-volumes/occlusion.glsl"
#include "methods/ambient-occlusion-volumes/ray.glsl"
#include "passes/bounce/receiver.glsl"

layout(std430) readonly buffer Occluders { Occluder occluders[]; };

uniform ivec2 picked;  // negative: none
uniform uint triangle_count;
uniform int both_sides;

#if !WRITE
layout(std430) writeonly buffer Found { uint concerned[]; };
#else
layout(std430) readonly buffer Concerned { uint concerned[]; };
layout(std430) readonly buffer Places { uint places[]; };
// C++: ir::methods::ambient_occlusion_volumes::TriangleNear
struct TriangleNear {
    float centre[3], normal[3], radius;
    uint triangle;
    float form_factor, weight, occlusion;
    uint hits, won;
    float distance;
};
layout(std430) writeonly buffer Explained { TriangleNear explained[]; };

#if BOUNCED
uniform sampler2DArray directions;
uniform usampler2DArray winners;
#endif

struct Rays {
    uint hits, won;
    float distance;  // of the nearest; -1: none
};

Rays rays_against(uint triangle, mat3 corners, vec3 origin) {
    Rays rays = Rays(0u, 0u, -1.0);
#if BOUNCED
    for (int i = 0; i < textureSize(directions, 0).z; ++i) {
        vec4 direction = texelFetch(directions, ivec3(picked, i), 0);
        if (direction.w == 0.0) continue;
        float t = hit_distance(triangle, corners, origin, direction.xyz, reach);
        if (t < 0.0) continue;
        ++rays.hits;
        if (texelFetch(winners, ivec3(picked, i), 0).x == triangle + 1u) ++rays.won;
        rays.distance = rays.distance < 0.0 ? t : min(rays.distance, t);
    }
#endif
    return rays;
}

void write(uint triangle, Volume v, Receiver receiver, vec3 x) {
    if (places[triangle] >= uint(explained.length())) return;
    vec3 centre = (v.corners[0] + v.corners[1] + v.corners[2]) / 3.0;
    float area = 0.5 * length(cross(v.corners[1] - v.corners[0], v.corners[2] - v.corners[0]));
    float factor = form_factor_of(v, x, receiver.normal);
    float weight = occluders[triangle].coverage * falloff_weight(v, x);
    Rays rays = rays_against(triangle, mat3(v.corners[0], v.corners[1], v.corners[2]), x);
    explained[places[triangle]] =
        TriangleNear(floats(centre), floats(v.normal), sqrt(area / PI), triangle, factor, weight, weight * factor,
                     rays.hits, rays.won, rays.distance);
}
#endif

void main() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= triangle_count) return;
#if !WRITE
    concerned[triangle] = 0u;
#endif
    if (picked.x < 0) return;
    Receiver receiver = receiver_at(picked);
    if (!receiver.exists || occluders[triangle].drawn == 0u) return;
    mat3 corners = corners_ws(triangle);
    Volume v = volume_of(corners[0], corners[1], corners[2]);
    vec3 x = offset_origin(receiver.position, receiver.geometric_normal);
#if WRITE
    if (concerned[triangle] != 0u) write(triangle, v, receiver, x);
#else
    if (is_within(v, x, reach, both_sides != 0)) concerned[triangle] = 1u;
#endif
}
