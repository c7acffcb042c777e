// Culls parts of triangles and splits those that are too large for the tessellator. ROUND 1: triangles; ROUND 2:
// the parts that the first round left, each as its own distance needs. Twice, to count and (PACKS) to write.
// SYSTEMATIC: parts are small beside their distance and few surfels large, triangles come in an order of their own.
layout(local_size_x = 64) in;
#define SCENE_POSITIONS
#define SCENE_INDICES
#include "passes/scene/scene.glsl"
#include "lib/random.glsl"
#include "methods/deep-screen-space/surfels/ideal.glsl"
#include "methods/deep-screen-space/surfels/patch.glsl"
#if ROUND == 2
#include "methods/deep-screen-space/surfels/parts.glsl"
#endif

#if ROUND == 2
layout(std430) readonly buffer Parts { Patch parts[]; };
layout(std430) readonly buffer PartCount { uint part_count; };
uniform uint part_capacity;
#endif
#if PACKS
layout(std430) readonly buffer Places { uint places[]; };
layout(std430) writeonly buffer Patches { Patch patches[]; };
uniform uint capacity;
#else
layout(std430) writeonly buffer Counts { uint counts[]; };
#endif
#if !PACKS && ROUND == 2
layout(std430) writeonly buffer WordCount { uint word_count; };
#endif
#if PACKS && ROUND == 2
uniform uint point_capacity;
layout(std430) writeonly buffer Points { uint point_counts[]; };  // of each patch
#if !SYSTEMATIC
layout(std430) buffer CoarseCount { uint coarse_count; };
#endif
#endif
#if PACKS && ROUND == 1
layout(std430) buffer TriangleCount { uint triangle_count; };
#endif

#if ROUND == 1 && SYSTEMATIC
layout(std430) readonly buffer Order { uint order[]; };
#endif
#if ROUND == 1
uniform uint first_item, end_item;
#else
uniform uint item_end;  // room in the list of words
#endif
uniform vec4 frustum[6];  // unit normals inwards
uniform int culls;
uniform float margin;     // m
uniform float fine_part;  // of the ideal area that surfels aim at

struct Corners {
    vec3 a, ab, ac;
};

Corners corners_of(uint triangle) {
    uvec3 vertices = scene_triangle(triangle);
    vec3 a = scene_position_ws(vertices.x);
    return Corners(a, scene_position_ws(vertices.y) - a, scene_position_ws(vertices.z) - a);
}

float area_of(Corners c) { return 0.5 * length(cross(c.ab, c.ac)); }

/// All corners on the far side of one plane.
bool is_outside(vec3 a, vec3 b, vec3 c) {
    if (culls == 0) return false;
    for (int i = 0; i < 6; ++i) {
        vec3 distances = vec3(dot(frustum[i].xyz, a), dot(frustum[i].xyz, b), dot(frustum[i].xyz, c)) + frustum[i].w;
        if (max(distances.x, max(distances.y, distances.z)) < -margin) return true;
    }
    return false;
}

vec3 nearest_on_segment(vec3 p, vec3 a, vec3 b) {
    vec3 ab = b - a;
    return a + clamp(dot(p - a, ab) / max(dot(ab, ab), 1e-30), 0.0, 1.0) * ab;
}

/// Distance of a point from a triangle.
float distance_to(vec3 p, vec3 a, vec3 b, vec3 c) {
    vec3 n = cross(b - a, c - a);
    bool inside = dot(cross(b - a, p - a), n) >= 0.0 && dot(cross(c - b, p - b), n) >= 0.0 &&
                  dot(cross(a - c, p - c), n) >= 0.0;
    if (inside) return abs(dot(p - a, n)) / max(length(n), 1e-30);
    return min(distance(p, nearest_on_segment(p, a, b)),
               min(distance(p, nearest_on_segment(p, b, c)), distance(p, nearest_on_segment(p, c, a))));
}

/// Not more than the least ideal area on the triangle: the ideal distance is the larger one of two convex ones.
float min_ideal_area(vec3 a, vec3 b, vec3 c) {
    vec3 along = vec3(dot(a - ideal_eye_ws, ideal_axis_ws), dot(b - ideal_eye_ws, ideal_axis_ws),
                      dot(c - ideal_eye_ws, ideal_axis_ws));
    float least = max(min(along.x, min(along.y, along.z)), ideal_corner_cosine * distance_to(ideal_eye_ws, a, b, c));
    return ideal_area_at(max(least, ideal_nearest));
}

vec3 corner_ws(Corners c, Patch p, vec2 uv) {
    vec2 weights = patch_weights(p, uv);
    return c.a + weights.x * c.ab + weights.y * c.ac;
}

/// Surfels that a part of the triangle needs.
float surfels_of(Corners c, Patch p) {
    float ideal = min_ideal_area(corner_ws(c, p, vec2(0)), corner_ws(c, p, vec2(1, 0)), corner_ws(c, p, vec2(0, 1)));
    return area_of(c) / (float(p.splits) * float(p.splits) * fine_part * ideal);
}

#if SYSTEMATIC
uniform uint seed;

/// The longest side, in distances of the nearest point; parallel views have no distance.
float length_of(Corners c, Patch p) {
    if (ideal_axis_ws == vec3(0)) return 0.0;
    vec3 bc = c.ac - c.ab;
    float side = sqrt(max(max(dot(c.ab, c.ab), dot(c.ac, c.ac)), dot(bc, bc))) / float(p.splits);
    float ideal = min_ideal_area(corner_ws(c, p, vec2(0)), corner_ws(c, p, vec2(1, 0)), corner_ws(c, p, vec2(0, 1)));
    return side * ideal_radius / sqrt(ideal / PI);
}

/// What the patch is worth, rounded at random: right on average however small it is.
uint units_of(Corners c, Patch p) {
    float ideal = ideal_area(corner_ws(c, p, vec2(1.0 / 3.0)));
    float surfels = area_of(c) / (float(p.splits) * float(p.splits) * ideal);
    return uint(surfels * float(UNITS_OF_SURFEL) + unit_float(pcg4d(uvec4(p.triangle, p.splits, p.place, seed)).x));
}
#endif

/// Into how many parts along each side; in the first round at most half of the way, as the parts' distances differ.
uint splits_of(Corners c, Patch p) {
#if SYSTEMATIC
    float needed = max(sqrt(surfels_of(c, p) / SURFELS_OF_PATCH), length_of(c, p) / MAX_PATCH_LENGTH);
#else
    float needed = sqrt(surfels_of(c, p) / float(tessellated_points(MAX_LEVEL)));
#endif
#if ROUND == 1
    if (needed > 4.0) needed = sqrt(needed);
#endif
    return uint(clamp(ceil(needed), 1.0, float(MAX_SPLITS)));
}

bool is_culled(Corners c, Patch p) {
    return is_outside(corner_ws(c, p, vec2(0)), corner_ws(c, p, vec2(1, 0)), corner_ws(c, p, vec2(0, 1)));
}

#if PACKS
void write(Corners c, Patch p, inout uint place) {
#if ROUND == 2 && SYSTEMATIC
    if (place < point_capacity) point_counts[place] = units_of(c, p);
#elif ROUND == 2
    float surfels = surfels_of(c, p);
    p.level = level_for(surfels);
    uint points = tessellated_points(p.level);
    if (place < point_capacity) point_counts[place] = points;
    if (surfels > float(points)) atomicAdd(coarse_count, 1u);
#endif
    if (place < capacity) patches[place] = p;
    ++place;
}
#else
void write(Corners c, Patch p, inout uint count) { ++count; }
#endif

void main() {
#if ROUND == 1
    uint item = first_item + gl_GlobalInvocationID.x;
    if (item >= end_item) return;
#else
    uint item = item_of_part();
#if !PACKS
    if (item == 0u) word_count = part_count;
#endif
    if (item >= item_end) return;
#endif
#if PACKS
    uint place = places[item];
#else
    uint place = 0u;
    counts[item] = 0u;
#endif
#if ROUND == 1
#if SYSTEMATIC
    Patch whole = Patch(order[item], 1u, 0u, 0u);
#else
    Patch whole = Patch(item, 1u, 0u, 0u);
#endif
#else
    if (item >= min(part_count, part_capacity)) return;
    Patch whole = parts[item];
#endif
    Corners c = corners_of(whole.triangle);
    if (!(area_of(c) > 0.0) || is_culled(c, whole)) return;
#if ROUND == 1 && PACKS
    uint first = place;
#endif
    uint splits = splits_of(c, whole);
    for (uint row = 0u; row < splits; ++row)
        for (uint column = 0u; column < splits - row; ++column) {
            Patch part = patch_part(whole, splits, uvec2(column, row), false);
            if (!is_culled(c, part)) write(c, part, place);
            if (column + row + 1u == splits) continue;
            part = patch_part(whole, splits, uvec2(column, row), true);
            if (!is_culled(c, part)) write(c, part, place);
        }
#if ROUND == 1 && PACKS
    if (place > first) atomicAdd(triangle_count, 1u);
#endif
#if !PACKS
    counts[item] = place;
#endif
}
