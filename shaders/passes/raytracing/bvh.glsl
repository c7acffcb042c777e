// First hits by the BVH that renderers/passes/raytracing/device_bvh.h describes.
#include "passes/raytracing/rays.glsl"
#include "passes/raytracing/triangle_hit.glsl"
#include "lib/coverage.glsl"

// Whole lines of 16 bytes, as words: no bits are lost, and each is one load.
layout(std430) readonly buffer BvhNodes { uvec4 bvh_nodes[]; };
layout(std430) readonly buffer BvhTriangles { uvec4 bvh_triangles[]; };
layout(std430) readonly buffer BvhMasks { uvec4 bvh_masks[]; };

/// What a node's word says of a child: an inner node's index, or with this set a leaf's number of triangles
/// (bits 28-30) and the index of the first one in the BVH's order (bits 0-27).
// C++: ir::passes::bvh_leaf
const uint BVH_LEAF = 0x80000000u;
const uint BVH_NO_CHILD = BVH_LEAF;
/// Inner nodes on the longest way from the root. A traversal's stack needs no more room: a node pushes at most one
/// child.
// C++: ir::passes::bvh_max_depth
const int BVH_MAX_DEPTH = 64;
/// Nodes and triangles that a ray may ask for; with the loops around them below the 65,535 iterations after
/// which llvmpipe ends loops.
const uint BVH_MAX_STEPS = 30000u;
/// Slabs are widened by this factor, some units in the last place. [Ize13]
const float BVH_SLACK = 1.000001;

/// Whether the ray meets the box before `far`, and where.
bool meets_box(vec3 low, vec3 high, vec3 origin, vec3 inverse, float far, out float entry) {
    vec3 a = (low - origin) * inverse, b = (high - origin) * inverse;
    vec3 first = min(a, b), last = max(a, b);
    entry = max(max(first.x, first.y), max(first.z, 0.0));
    float exit = min(min(last.x, last.y), last.z);
    return entry <= min(exit * BVH_SLACK, far) * BVH_SLACK;
}

/// 1 / d; axes to which the ray is parallel get a large number in place of an infinite one, whose products
/// with 0 are NaN.
vec3 safe_inverse(vec3 d) {
    vec3 least = vec3(d.x < 0.0 ? -1e-18 : 1e-18, d.y < 0.0 ? -1e-18 : 1e-18, d.z < 0.0 ? -1e-18 : 1e-18);
    return 1.0 / mix(d, least, lessThan(abs(d), vec3(1e-18)));
}

/// `mask`: index + 1 of the masks.
bool is_covered_at(uint mask, float u, float v) {
    uvec4 ab = bvh_masks[2u * (mask - 1u)], c = bvh_masks[2u * (mask - 1u) + 1u];
    precise vec2 uv = (1.0 - u - v) * uintBitsToFloat(ab.xy) + u * uintBitsToFloat(ab.zw) +
                      v * uintBitsToFloat(c.xy);
    return is_covered(c.z, uv);
}

/// Keeps what is closer, and of what is equally far the triangle with the lower number: the result does not
/// depend on the tree.
void query_triangle(uint place, Ray ray, inout RayHit hit) {
    uvec4 a = bvh_triangles[3u * place], b = bvh_triangles[3u * place + 1u],
          c = bvh_triangles[3u * place + 2u];
    float distance, u, v;
    if (!hits_triangle(uintBitsToFloat(a.xyz) - ray.origin_ws, uintBitsToFloat(b.xyz) - ray.origin_ws,
                       uintBitsToFloat(c.xyz) - ray.origin_ws, ray.direction_ws, distance, u, v))
        return;
    if (!(distance > 0.0) || !(distance < RAY_INFINITY) || distance > hit.distance) return;
    if (distance == hit.distance && a.w >= hit.triangle) return;
    if (b.w != 0u && !is_covered_at(b.w, u, v)) return;
    hit = RayHit(distance, a.w, u, v);
}

/// False where the ray asked for more than BVH_MAX_STEPS: the hit is the first one of what was seen.
bool find_first_hit(Ray ray, out RayHit result) {
    vec3 inverse = safe_inverse(ray.direction_ws);
    RayHit hit = RayHit(ray.far, 0xffffffffu, 0.0, 0.0);
    uint stack[BVH_MAX_DEPTH + 1], steps = 0u, next = 0u;
    stack[0] = BVH_NO_CHILD;
    int top = 1;
    while (next != BVH_NO_CHILD && steps < BVH_MAX_STEPS) {
        while ((next & BVH_LEAF) == 0u && steps < BVH_MAX_STEPS) {
            ++steps;
            uvec4 n0 = bvh_nodes[4u * next], n1 = bvh_nodes[4u * next + 1u], n2 = bvh_nodes[4u * next + 2u],
                  n3 = bvh_nodes[4u * next + 3u];
            float left_entry, right_entry;
            bool left = meets_box(uintBitsToFloat(n0.xyz), uintBitsToFloat(n1.xyz), ray.origin_ws, inverse,
                                  hit.distance, left_entry);
            bool right = meets_box(uintBitsToFloat(n2.xyz), uintBitsToFloat(n3.xyz), ray.origin_ws, inverse,
                                   hit.distance, right_entry);
            left = left && n0.w != BVH_NO_CHILD;
            right = right && n1.w != BVH_NO_CHILD;
            bool left_first = left && (!right || left_entry <= right_entry);
            next = left_first ? n0.w : n1.w;
            if (left && right)
                stack[top++] = left_first ? n1.w : n0.w;
            else if (!left && !right)
                next = stack[--top];
        }
        if (next == BVH_NO_CHILD || (next & BVH_LEAF) == 0u) break;
        uint place = next & 0x0fffffffu, end = place + (next >> 28u & 7u);
        for (; place < end; ++place) {
            ++steps;
            query_triangle(place, ray, hit);
        }
        next = ray.any_hit != 0.0 && hit.triangle != 0xffffffffu ? BVH_NO_CHILD : stack[--top];
    }
    result = hit.triangle == 0xffffffffu ? no_hit() : hit;
    return next == BVH_NO_CHILD;
}
