// Compute rasteriser, second step. One invocation: one strip of eight rows of a large triangle in one map.
// Edge functions are whole numbers below 2^53, exact in double.
layout(local_size_x = 64) in;
#include "passes/ldm/triangle_rows.glsl"
#include "passes/ldm/fragments.glsl"
#include "passes/ldm/list_index.glsl"
#ifdef MASKED
#include "passes/ldm/mask.glsl"
#endif

layout(std430) readonly buffer LdmLarge { uvec2 large[]; };

uniform int resolution;
uniform uint opaque_triangles;  // triangles from here on have alpha masks

const int STRIP_ROWS = 8;

/// cross(b - a, p - a) = constant + per_column * x + per_row * y at texel (x, y)'s centre.
struct Edge {
    double constant, per_column, per_row;
    double least;  // inside from here on: 0 for top and left edges, else 1
};

Edge edge_from(dvec2 a, dvec2 b) {
    dvec2 d = b - a;
    bool owns_ties = d.y < 0.0lf || (d.y == 0.0lf && d.x > 0.0lf);
    double constant = d.x * (128.0lf - a.y) - d.y * (128.0lf - a.x);
    return Edge(constant, -d.y * 256.0lf, d.x * 256.0lf, owns_ties ? 0.0lf : 1.0lf);
}

double at(Edge e, int x, int y) {
    return e.constant + e.per_column * double(x) + e.per_row * double(y);
}

bool is_inside(Edge bc, Edge ca, Edge ab, int x, int y) {
    return at(bc, x, y) >= bc.least && at(ca, x, y) >= ca.least && at(ab, x, y) >= ab.least;
}

/// Narrows first … last to the columns inside the edge, give or take two.
void narrow(Edge e, int y, inout int first, inout int last) {
    double value = e.constant + e.per_row * double(y);
    if (e.per_column == 0.0lf) {
        if (value < e.least) last = -1;
        return;
    }
    int column = int(clamp(floor((e.least - value) / e.per_column), -4.0lf, double(resolution) + 4.0lf));
    if (e.per_column > 0.0lf)
        first = max(first, column - 1);
    else
        last = min(last, column + 2);
}

void main() {
    uint index = list_index();
    if (index >= min(large_count, uint(large.length()))) return;
    uint triangle = large[index].x, map = large[index].y & 255u;
    int top = int(large[index].y >> 8) * STRIP_ROWS;
#ifdef MASKED
    if (triangle < opaque_triangles) return;
#else
    if (triangle >= opaque_triangles) return;
#endif
    uvec3 corners = scene_triangle(triangle);
#ifdef LDM_FACES
    set_face(corners);
#endif
    MapTriangle t = projected(scene_position_ws(corners.x), scene_position_ws(corners.y),
                              scene_position_ws(corners.z), map);
    dvec2 a = dvec2(t.a), b = dvec2(t.b), c = dvec2(t.c);
    double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0.0lf) return;
    if (area < 0.0lf) {
        dvec2 swapped = b;
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
    vec2 low, high;
    texel_box(t.a, t.b, t.c, low, high);
    int bottom = min(min(top + STRIP_ROWS - 1, int(high.y)), resolution - 1);
    for (int y = max(top, int(low.y)); y <= bottom; ++y) {
        int first = max(int(low.x), 0), last = min(int(high.x), resolution - 1);
        narrow(bc, y, first, last);
        narrow(ca, y, first, last);
        narrow(ab, y, first, last);
        while (first <= last && !is_inside(bc, ca, ab, first, y)) ++first;
        while (first <= last && !is_inside(bc, ca, ab, last, y)) --last;
        if (first > last) continue;
        uint row = (map * uint(resolution) + uint(y)) * uint(resolution);
#ifndef MASKED
        uint place = reserve_fragments(uint(last - first + 1));
#endif
        for (int x = first; x <= last; ++x) {
            vec3 weights = vec3(dvec3(at(bc, x, y), at(ca, x, y), at(ab, x, y)) / area);
#ifdef MASKED
            if (!is_covered(triangle, corners, weights)) continue;
            uint place = reserve_fragments(1u);
#endif
            put_fragment(place, row + uint(x), quantised(dot(weights, t.depth)));
#ifndef MASKED
            ++place;
#endif
        }
    }
}
