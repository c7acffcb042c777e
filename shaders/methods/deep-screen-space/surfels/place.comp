// Surfels along a curve through all patches, one at random in each piece that is worth one. The curve visits
// triangles and their parts by where they lie, so that what follows each other is close together.
layout(local_size_x = 64) in;
#include "lib/random.glsl"
#include "lib/triangle_plane.glsl"
#include "methods/deep-screen-space/records.glsl"
#define SCENE_POSITIONS
#include "methods/deep-screen-space/surfels/holes.glsl"
#include "methods/deep-screen-space/surfels/ideal.glsl"
#include "methods/deep-screen-space/surfels/patch.glsl"
#include "methods/deep-screen-space/surfels/parts.glsl"

layout(std430) readonly buffer Patches { Patch patches[]; };
layout(std430) readonly buffer Points { uint points[]; };  // units before each patch
layout(std430) readonly buffer PatchCount { uint patch_count; };
layout(std430) readonly buffer UnitCount { uint unit_count; };
layout(std430) writeonly buffer Surfels { Surfel surfels[]; };
layout(std430) writeonly buffer SurfelCount { uint surfel_count; };
layout(std430) writeonly buffer WordCount { uint word_count; };

uniform uint seed;
uniform uint patch_capacity, capacity;

/// Of the piece of the curve: where the surfel lies on it, in units.
uint unit_of(uint surfel) {
    return surfel * UNITS_OF_SURFEL + pcg4d(uvec4(surfel, seed, 0x5f3759dfu, 0u)).x % UNITS_OF_SURFEL;
}

/// The last patch with no more units before it; those without units are never it.
uint patch_at(uint unit) {
    uint first = 0u, end = min(patch_count, patch_capacity);
    while (first + 1u < end) {
        uint middle = (first + end) / 2u;
        if (points[middle] <= unit)
            first = middle;
        else
            end = middle;
    }
    return first;
}

uint end_of(uint patch_index) {
    return patch_index + 1u < min(patch_count, patch_capacity) ? points[patch_index + 1u] : unit_count;
}

/// A curve through the triangle with corners 0, (1, 0) and (0, 1) that covers it evenly: each digit of t to the base
/// of four chooses a quarter of what is left.  [Basu15 §4]
vec2 on_triangle(uint t) {
    vec2 a = vec2(0), b = vec2(1, 0), c = vec2(0, 1);
    for (int i = 0; i < 16; ++i, t <<= 2) {
        vec2 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
        uint digit = t >> 30;
        if (digit == 0u) {
            b = ab, c = ca;
        } else if (digit == 1u) {
            a = bc, b = ca, c = ab;
        } else if (digit == 2u) {
            a = ab, c = bc;
        } else {
            a = ca, b = bc;
        }
    }
    return (a + b + c) / 3.0;
}

void main() {
    uint item = item_of_part();
    if (item == 0u) {
        uint pieces = (unit_count + UNITS_OF_SURFEL - 1u) / UNITS_OF_SURFEL;
        // The last piece is a part of one: as likely as it is large.
        surfel_count = pieces > 0u && unit_of(pieces - 1u) >= unit_count ? pieces - 1u : pieces;
        word_count = patch_count;
    }
    uint unit = unit_of(item);
    if (item >= capacity || unit >= unit_count || patch_count == 0u) return;
    uint index = patch_at(unit);
    Patch p = patches[index];
    uvec4 random = pcg4d(uvec4(item, seed, p.triangle, p.place));
    float units = float(max(end_of(index) - points[index], 1u));
    float t = (float(unit - points[index]) + unit_float(random.x)) / units;
    vec2 weights = patch_weights(p, on_triangle(uint(min(t, 0.99999994) * 4294967296.0)));

    uvec3 corners = scene_triangle(p.triangle);
    vec3 a = scene_position_ws(corners.x), b = scene_position_ws(corners.y), c = scene_position_ws(corners.z);
    vec2 middle = patch_weights(p, vec2(1.0 / 3.0));
    float area = ideal_area(a + middle.x * (b - a) + middle.y * (c - a));
    uint barycentrics = packUnorm2x16(weights);
    float radius = is_surface_there(p.triangle, barycentrics) ? sqrt(area / PI) : 0.0;
    surfels[item] = Surfel(a + weights.x * (b - a) + weights.y * (c - a), p.triangle, triangle_plane(a, b, c).normal,
                           radius, barycentrics, random.z ^ pcg(random.w), item, 0u);
}
