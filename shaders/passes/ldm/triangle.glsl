// Triangles in maps: projection, snapping and the rule that says which texel centres a triangle covers.
#include "passes/ldm/frames.glsl"
#define SCENE_POSITIONS
#define SCENE_INDICES
#ifdef MASKED
#define SCENE_TRIANGLE_MATERIALS
#define SCENE_UV0
#define SCENE_UV1
#endif
#include "passes/scene/scene.glsl"

const float SUBTEXELS = 256.0;

/// Corners in subtexels, whole numbers below 2^24, so that all builders cover the same texels; depths in
/// quanta.
struct MapTriangle {
    vec2 a, b, c;
    vec3 depth;
};

vec2 snapped(vec3 position, vec4 u, vec4 v) {
    return floor(vec2(dot(position, u.xyz) + u.w, dot(position, v.xyz) + v.w) * SUBTEXELS + 0.5);
}

MapTriangle projected(vec3 a, vec3 b, vec3 c, vec4 u, vec4 v, vec4 depth) {
    vec3 depths = vec3(dot(a, depth.xyz), dot(b, depth.xyz), dot(c, depth.xyz));
    return MapTriangle(snapped(a, u, v), snapped(b, u, v), snapped(c, u, v), depths + depth.w);
}
MapTriangle projected(vec3 a, vec3 b, vec3 c, MapFrame frame) {
    return projected(a, b, c, frame.u, frame.v, frame.depth);
}

/// Quanta per texel that a triangle's plane gains along a column and a row. `b` and `c` are corners from the first
/// one, in subtexels; `area` is their cross product, not 0.
vec2 slope_of(vec2 b, vec2 c, float area, vec3 depth) {
    vec2 gain = (depth.yz - depth.x) / area;
    return SUBTEXELS * vec2(gain.x * c.y - gain.y * b.y, gain.y * b.x - gain.x * c.x);
}

/// Texels whose centres are inside the triangle's bounding box: low.x … high.x, low.y … high.y.
void texel_box(vec2 a, vec2 b, vec2 c, out vec2 low, out vec2 high) {
    low = ceil(min(min(a, b), c) * (1.0 / SUBTEXELS) - 0.5);
    high = floor(max(max(a, b), c) * (1.0 / SUBTEXELS) - 0.5);
}
