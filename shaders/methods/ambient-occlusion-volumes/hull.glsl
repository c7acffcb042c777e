// The prism that is drawn: a hexagon, extruded. It encloses the volume with all that rounding may move, and is
// convex, so that its faces that look away from the viewer cover each pixel once.
#include "methods/ambient-occlusion-volumes/volume.glsl"
#include "passes/raytracing/ray_offset.glsl"

uniform vec4 viewer_ws;          // the eye, w = 1; orthographic views: towards the viewer, w = 0
uniform vec3 view_axis_ws;
uniform vec2 pixel_size;         // m, of a pixel: x + y · depth
uniform float reach;
uniform int both_sides;

struct Hull {
    Volume volume;
    float reach, low, high;  // low, high: along the normal, m
};

/// 1/20 pixel where the volume is farthest away, and what rounding may make of positions and planes: corners of
/// slivers lie off their own plane.
float margin_of(Volume v) {
    float depth = 0.0, off = 0.0, offset = 0.0;
    for (int i = 0; i < 3; ++i) {
        vec3 p = v.corners[i];
        depth = max(depth, dot(view_axis_ws, p - viewer_ws.xyz));
        offset = max(offset, ray_offset(abs(p) + reach));
        off = max(off, abs(height_over(v, p)));
        for (int j = 0; j < 3; ++j) off = max(off, max(beyond_edge(v, j, p), dot(v.bisectors[j], p - v.corners[j])));
    }
    return off + 1e-3 * reach + 2.0 * offset +
           0.05 * (pixel_size.x + pixel_size.y * max(depth + 2.0 * reach, 0.0));
}

Hull hull_of(Volume v) {
    float margin = margin_of(v);
    return Hull(v, reach + margin, both_sides != 0 ? -reach - margin : -margin, reach + margin);
}

/// Corner k of the hexagon, in the triangle's plane; two belong to each corner of the triangle.
vec3 hexagon_corner(Hull h, int k) {
    int i = k >> 1;
    vec3 m = h.volume.edge_normals[(k & 1) == 0 ? (i + 2) % 3 : i], b = h.volume.bisectors[i];
    return h.volume.corners[i] + h.reach / (1.0 + dot(m, b)) * (m + b);
}

/// Of the side between the corners k and k + 1.
vec3 side_normal(Hull h, int k) { return (k & 1) == 0 ? h.volume.bisectors[k >> 1] : h.volume.edge_normals[k >> 1]; }

/// Whether the face with this outward normal, `above` over the point, looks away from the viewer.
bool looks_away(vec3 normal, vec3 point, float above) {
    return dot(normal, viewer_ws.xyz - viewer_ws.w * point) - viewer_ws.w * above < 0.0;
}
