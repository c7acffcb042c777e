// The region within which a triangle occludes: a prism over the triangle, moved out by `reach`. [McGuire10]
//
// DEVIATION [McGuire10]: the prism's corners are cut off at `reach` from the triangle's. Where two moved edges meet
// instead, the corner of a sliver lies any distance away, so that a needle would be drawn over the whole picture.
// All points nearer than `reach` to the triangle are inside either way.
#include "lib/triangle_plane.glsl"

struct Volume {
    vec3 corners[3];
    vec3 normal;           // unit, by the winding; 0: the triangle has no area
    vec3 edge_normals[3];  // unit, in the triangle's plane, outwards; of the edge from corner i to the next
    vec3 bisectors[3];     // unit, in the plane, outwards; of corner i
};

Volume volume_of(vec3 a, vec3 b, vec3 c) {
    Volume v;
    v.corners = vec3[](a, b, c);
    v.normal = triangle_plane(a, b, c).normal;
    vec3 edges[3] = vec3[](normalize(b - a), normalize(c - b), normalize(a - c));
    for (int i = 0; i < 3; ++i) v.edge_normals[i] = normalize(cross(edges[i], v.normal));
    // Of the two sums, which are parallel, at least one is long.
    for (int i = 0; i < 3; ++i) {
        int before = (i + 2) % 3;
        v.bisectors[i] = normalize(v.edge_normals[before] + v.edge_normals[i] + edges[before] - edges[i]);
    }
    return v;
}

bool has_area(Volume v) { return v.normal != vec3(0.0) && !any(isnan(v.bisectors[0] + v.bisectors[1] + v.bisectors[2])); }

/// Above the triangle's plane, m; its sign is the side.
float height_over(Volume v, vec3 x) { return dot(v.normal, x - v.corners[0]); }

/// Out of the triangle's edge i, m; negative inside.
float beyond_edge(Volume v, int i, vec3 x) { return dot(v.edge_normals[i], x - v.corners[i]); }

bool is_within(Volume v, vec3 x, float reach, bool both_sides) {
    float height = height_over(v, x);
    if (!(abs(height) <= reach) || (!both_sides && height < 0.0)) return false;
    for (int i = 0; i < 3; ++i)
        if (beyond_edge(v, i, x) > reach || dot(v.bisectors[i], x - v.corners[i]) > reach) return false;
    return true;
}
