// Which of several points of a texel with equal depths has which face is left open by rasterising; here it is settled,
// the same in every run: faces take turns, front and back, as along a line through closed bodies, and among those of
// one side the normals' bits decide. One invocation: one texel.
layout(local_size_x = 64) in;
#include "passes/ldm/point.glsl"

layout(std430) readonly buffer LdmPointTexels { uint first_points[]; };
layout(std430) buffer LdmPoints { uint points[]; };

uniform uint texel_count;

struct Face {
    uvec3 normal;
    uint facing;
};

Face face_of(uint point) {
    uint word = POINT_WORDS * point;
    return Face(uvec3(points[word + POINT_NORMAL], points[word + POINT_NORMAL + 1u], points[word + POINT_NORMAL + 2u]),
                points[word + POINT_FACING]);
}

void set_face(uint point, Face face) {
    uint word = POINT_WORDS * point;
    for (uint i = 0u; i < 3u; ++i) points[word + POINT_NORMAL + i] = face.normal[i];
    points[word + POINT_FACING] = face.facing;
}

bool is_before(uvec3 a, uvec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

void main() {
    if (gl_GlobalInvocationID.x >= texel_count) return;
    uint point = first_points[gl_GlobalInvocationID.x];
    uint end = min(first_points[gl_GlobalInvocationID.x + 1u], uint(points.length()) / POINT_WORDS);
    const uint front = floatBitsToUint(1.0), back = floatBitsToUint(-1.0);
    uint wanted = front;
    for (; point < end; ++point) {
        Face least = face_of(point);
        uint found = point, depth = points[POINT_WORDS * point + POINT_DEPTH];
        for (uint other = point + 1u; other < end && points[POINT_WORDS * other + POINT_DEPTH] == depth; ++other) {
            Face face = face_of(other);
            bool better = face.facing != least.facing ? face.facing == wanted : is_before(face.normal, least.normal);
            if (!better) continue;
            least = face;
            found = other;
        }
        if (found != point) {
            set_face(found, face_of(point));
            set_face(point, least);
        }
        wanted = least.facing == front ? back : front;
    }
}
