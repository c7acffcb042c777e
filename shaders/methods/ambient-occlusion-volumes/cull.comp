// Which triangles' volumes are drawn, and how much of each triangle its mask covers.
layout(local_size_x = 64) in;
#include "methods/ambient-occlusion-volumes/triangle.glsl"
#include "methods/ambient-occlusion-volumes/hull.glsl"

layout(std430) writeonly buffer Occluders { Occluder occluders[]; };
layout(std430) buffer Drawn { uint drawn_count; };
layout(std430) buffer Culled { uint culled_count; };

// Without CULLING only triangles without area are left out.
uniform sampler2D tile_low;
uniform sampler2D tile_high;

uniform uint first_triangle, end_triangle;
uniform int side;  // of a tile, pixels
uniform vec2 size_px;
uniform mat4 clip_from_world;

/// Mean of the mask over a triangle, at the middles of 64 parts.
/// DEVIATION [McGuire10]: there it is read from a coarse level of the texture at the triangle's middle.
float mean_coverage(uint triangle) {
    if (triangle < opaque_triangles) return 1.0;
    int covered = 0;
    for (int row = 0; row < 8; ++row)
        for (int i = 0; i < 2 * row + 1; ++i) {
            float from = (float(row) + ((i & 1) == 0 ? 2.0 : 1.0) / 3.0) / 8.0;
            float u = (float(i / 2) + ((i & 1) == 0 ? 1.0 : 2.0) / 3.0) / 8.0;
            if (is_there(triangle, u, from - u)) ++covered;
        }
    return float(covered) / 64.0;
}

bool lies_beyond(vec3 normal, float level, vec3 middle, vec3 half_size) {
    return dot(normal, middle) - dot(abs(normal), half_size) > level;
}

/// Whether one of the volume's planes lies between it and all that the tile shows.
bool is_apart(Hull h, vec3 low, vec3 high, vec3 tile_low_ws, vec3 tile_high_ws) {
    if (any(greaterThan(tile_low_ws, high)) || any(lessThan(tile_high_ws, low))) return true;
    // relative to a corner, since large coordinates cancel
    vec3 middle = 0.5 * (tile_low_ws + tile_high_ws) - h.volume.corners[0], half_size = 0.5 * (tile_high_ws - tile_low_ws);
    if (lies_beyond(h.volume.normal, h.high, middle, half_size) || lies_beyond(-h.volume.normal, -h.low, middle, half_size))
        return true;
    for (int i = 0; i < 3; ++i) {
        vec3 from = middle + h.volume.corners[0] - h.volume.corners[i];
        if (lies_beyond(h.volume.edge_normals[i], h.reach, from, half_size) ||
            lies_beyond(h.volume.bisectors[i], h.reach, from, half_size))
            return true;
    }
    return false;
}

bool is_seen(Hull h) {
    vec3 low = vec3(3e38), high = vec3(-3e38);
    vec2 first_px = vec2(3e38), last_px = vec2(-3e38);
    bool left = true, right = true, below = true, over = true, behind = true, in_front = true;
    for (int k = 0; k < 12; ++k) {
        vec3 p = hexagon_corner(h, k % 6) + (k < 6 ? h.low : h.high) * h.volume.normal;
        low = min(low, p);
        high = max(high, p);
        vec4 q = clip_from_world * vec4(p, 1.0);
        left = left && q.x < -q.w;
        right = right && q.x > q.w;
        below = below && q.y < -q.w;
        over = over && q.y > q.w;
        behind = behind && q.w <= 0.0;
        in_front = in_front && q.w > 0.0;
        vec2 at = (q.xy / q.w * vec2(0.5, -0.5) + 0.5) * size_px;
        first_px = min(first_px, at);
        last_px = max(last_px, at);
    }
    if (left || right || below || over || behind) return false;
    ivec2 last_tile = textureSize(tile_low, 0) - 1, begin = ivec2(0), end = last_tile;
    if (in_front) {
        begin = ivec2(floor(clamp(first_px - 1.0, vec2(0.0), size_px) / float(side)));
        end = min(ivec2(floor(clamp(last_px + 1.0, vec2(0.0), size_px) / float(side))), last_tile);
    }
    for (int y = begin.y; y <= end.y; ++y)
        for (int x = begin.x; x <= end.x; ++x) {
            vec4 least = texelFetch(tile_low, ivec2(x, y), 0);
            if (least.w > 0.0 && !is_apart(h, low, high, least.xyz, texelFetch(tile_high, ivec2(x, y), 0).xyz)) return true;
        }
    return false;
}

void main() {
    uint triangle = first_triangle + gl_GlobalInvocationID.x;
    if (triangle >= end_triangle) return;
    mat3 corners = corners_ws(triangle);
    Volume v = volume_of(corners[0], corners[1], corners[2]);
    bool drawn = has_area(v);
#if CULLING
    if (drawn && !is_seen(hull_of(v))) drawn = false;
#endif
    occluders[triangle] = Occluder(drawn ? 1u : 0u, mean_coverage(triangle));
    if (drawn)
        atomicAdd(drawn_count, 1u);
    else
        atomicAdd(culled_count, 1u);
}
