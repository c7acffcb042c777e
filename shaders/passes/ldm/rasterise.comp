// Compute rasteriser, first step. One invocation: one triangle in up to 32 maps. Most triangles cover no texel
// centre in most maps; a first loop finds those maps that the others go on with, so that neighbouring
// invocations work on their next map at the same time. Triangles whose box has more than 32 texel centres
// are cut into strips of rows for the next step.
layout(local_size_x = 64) in;
#include "passes/ldm/triangle_rows.glsl"
#include "passes/ldm/fragments.glsl"
#ifdef MASKED
#include "passes/ldm/mask.glsl"
#endif

/// x: triangle, y: map of the chunk | strip << 8.
layout(std430) writeonly buffer LdmLarge { uvec2 large[]; };

uniform uint first_item, end_item;  // triangles
uniform uint map_count;             // at most 32
uniform int resolution;

const int STRIP_ROWS = 8;

void cut_into_strips(uint triangle, uint map, int low_row, int high_row) {
    uint first = uint(low_row / STRIP_ROWS), count = uint(high_row / STRIP_ROWS) - first + 1u;
    uint place = atomicAdd(large_count, count);
    for (uint i = 0u; i < count; ++i)
        if (place + i < uint(large.length())) large[place + i] = uvec2(triangle, map | (first + i) << 8);
}

/// cross(b - a, p - a) at the box's first centre, and its change per column and row; ties belong to top and
/// left edges.
struct Edge {
    int value, per_column, per_row;
    int bias;
};

Edge edge_from(ivec2 a, ivec2 b) {
    ivec2 d = b - a;
    bool owns_ties = d.y < 0 || (d.y == 0 && d.x > 0);
    return Edge(d.y * a.x - d.x * a.y, -d.y * 256, d.x * 256, owns_ties ? 0 : -1);
}

void rasterise_small(uint triangle, uvec3 corners, uint map, MapTriangle t, ivec2 low, ivec2 size) {
    vec2 origin = (vec2(low) + 0.5) * SUBTEXELS;
    ivec2 a = ivec2(t.a - origin), b = ivec2(t.b - origin), c = ivec2(t.c - origin);
    int area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0) return;
    if (area < 0) {
        ivec2 swapped = b;
        b = c;
        c = swapped;
        t.depth = t.depth.xzy;
        corners = corners.xzy;
        area = -area;
    }
#ifdef LDM_SLOPES
    triangle_slopes =
        ldm_slope_codes(slope_of(vec2(b - a), vec2(c - a), float(area), t.depth), texel_quanta_of(map));
#endif
    Edge bc = edge_from(b, c), ca = edge_from(c, a), ab = edge_from(a, b);
    ivec3 row = ivec3(bc.value, ca.value, ab.value), bias = ivec3(bc.bias, ca.bias, ab.bias);
    ivec3 per_column = ivec3(bc.per_column, ca.per_column, ab.per_column);
    ivec3 per_row = ivec3(bc.per_row, ca.per_row, ab.per_row);
    float scale = 1.0 / float(area);
    uint covered = 0u, bit = 1u;
    for (int y = 0; y < size.y; ++y) {
        ivec3 e = row;
        for (int x = 0; x < size.x; ++x) {
            ivec3 inside = e + bias;
            bool hit = (inside.x | inside.y | inside.z) >= 0;
#ifdef MASKED
            if (hit) hit = is_covered(triangle, corners, vec3(e) * scale);
#endif
            covered |= hit ? bit : 0u;
            bit <<= 1;
            e += per_column;
        }
        row += per_row;
    }
    if (covered == 0u) return;
    uint place = reserve_fragments(uint(bitCount(covered)));
    uint first_texel = (map * uint(resolution) + uint(low.y)) * uint(resolution) + uint(low.x);
    ivec3 start = ivec3(bc.value, ca.value, ab.value);
    while (covered != 0u) {
        int k = findLSB(covered);
        covered &= covered - 1u;
        int y = k / size.x, x = k - y * size.x;
        vec3 weights = vec3(start + per_column * x + per_row * y) * scale;
        put_fragment(place, first_texel + uint(y * resolution + x), quantised(dot(weights, t.depth)));
        ++place;
    }
}

void main() {
    uint triangle = first_item + gl_GlobalInvocationID.x;
    if (triangle >= end_item) return;
    uvec3 corners = scene_triangle(triangle);
    vec3 a = scene_position_ws(corners.x), b = scene_position_ws(corners.y), c = scene_position_ws(corners.z);
#ifdef LDM_FACES
    set_face(corners);
#endif
    uint maps = 0u;
    for (uint i = 0u; i < map_count; ++i) {
        vec4 u = frame_rows[3u * i], v = frame_rows[3u * i + 1u];
        vec2 low, high;
        texel_box(snapped(a, u, v), snapped(b, u, v), snapped(c, u, v), low, high);
        if (low.x <= high.x && low.y <= high.y) maps |= 1u << i;
    }
    while (maps != 0u) {
        uint map = uint(findLSB(maps));
        maps &= maps - 1u;
        MapTriangle t = projected(a, b, c, map);
        vec2 low, high;
        texel_box(t.a, t.b, t.c, low, high);
        ivec2 first = max(ivec2(low), ivec2(0)), last = min(ivec2(high), ivec2(resolution - 1));
        ivec2 size = last - first + 1;
        if (size.x <= 0 || size.y <= 0) continue;
        // The box, not the triangle, is clamped to the map; a clamped box may belong to a larger triangle.
        bool clamped = first != ivec2(low) || last != ivec2(high);
        if (size.x * size.y > 32 || clamped)
            cut_into_strips(triangle, map, first.y, last.y);
        else
            rasterise_small(triangle, corners, map, t, first, size);
    }
}
