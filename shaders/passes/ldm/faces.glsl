// In place of a list of fragments: the points of maps that are rasterised again. A fragment gives normal and facing
// to a point of its texel that has its depth and no face yet; so each point ends with the face of a triangle that
// made such an entry. Include triangle.glsl first.
#include "passes/ldm/point.glsl"
#ifdef LDM_PACKED_BITS
#include "passes/ldm/packed_depth.glsl"
#endif

layout(std430) coherent buffer LdmPoints { uint face_points[]; };
/// First point of each texel that has points, and where the last one's end.
layout(std430) readonly buffer LdmPointTexels { uint first_points[]; };

uniform uint face_texel;   // first texel of the dispatch's maps, counted through the maps shown in the batch
uniform uint face_stride;  // every so many texels have points

vec3 face_normal;  // unit length, on the side that sees the corners counter-clockwise

void set_face(uvec3 corners) {
    vec3 a = scene_position_ws(corners.x), b = scene_position_ws(corners.y) - a,
         c = scene_position_ws(corners.z) - a;
    // In units of its size, so that the product of small triangles' sides does not vanish.
    float size = max(max(length(b), length(c)), 1e-30);
    vec3 normal = cross(b / size, c / size);
    face_normal = normal / max(length(normal), 1e-30);
}

uint reserve_fragments(uint count) {
    return 0u;
}

float face_depth(uint point) {
    return uintBitsToFloat(face_points[POINT_WORDS * point + POINT_DEPTH]);
}

// Points of a texel are sorted by depth. Written out, since drivers may stop loops after 65,535 turns in all.
#define FACE_SKIP(STEP) \
    if (point + STEP <= end && face_depth(point + STEP - 1u) < metres) point += STEP;

void put_fragment(uint place, uint texel, uint depth) {
    uint index = face_texel + texel;
    if (index % face_stride != 0u) return;
    uint point = first_points[index / face_stride];
    uint end = min(first_points[index / face_stride + 1u], uint(face_points.length()) / POINT_WORDS);
    if (point >= end) return;
#ifdef LDM_PACKED_BITS
    depth = unpacked_depth(packed_depth(depth));
#endif
    MapFrame frame = ldm_frames[face_points[POINT_WORDS * point + POINT_MAP]];
    float metres = ldm_metres(frame, depth);
    FACE_SKIP(32768u)
    FACE_SKIP(16384u)
    FACE_SKIP(8192u)
    FACE_SKIP(4096u)
    FACE_SKIP(2048u)
    FACE_SKIP(1024u)
    FACE_SKIP(512u)
    FACE_SKIP(256u)
    FACE_SKIP(128u)
    FACE_SKIP(64u)
    FACE_SKIP(32u)
    FACE_SKIP(16u)
    FACE_SKIP(8u)
    FACE_SKIP(4u)
    FACE_SKIP(2u)
    FACE_SKIP(1u)
    uint side = floatBitsToUint(dot(face_normal, frame.direction.xyz) < 0.0 ? 1.0 : -1.0);
    for (; point < end && face_depth(point) == metres; ++point) {
        uint word = POINT_WORDS * point;
        if (atomicCompSwap(face_points[word + POINT_FACING], 0u, side) != 0u) continue;
        for (uint i = 0u; i < 3u; ++i) face_points[word + POINT_NORMAL + i] = floatBitsToUint(face_normal[i]);
        return;
    }
}
