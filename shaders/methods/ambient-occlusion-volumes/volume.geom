// The faces of a triangle's volume that look away from the viewer: they also cover the pixels inside where the
// viewer is inside.
layout(points) in;
layout(triangle_strip, max_vertices = 36) out;
#include "methods/ambient-occlusion-volumes/hull.glsl"

uniform mat4 clip_from_world;

layout(location = 0) flat in uint triangle[];
layout(location = 1) flat in uint drawn[];
layout(location = 2) flat in vec3 a_ws[];
layout(location = 3) flat in vec3 b_ws[];
layout(location = 4) flat in vec3 c_ws[];

layout(location = 0) flat out uint occluder;

void emit(vec4 position_cs) {
    occluder = triangle[0];
    gl_Position = position_cs;
    EmitVertex();
}

void emit_cap(vec4 corners_cs[6]) {
    const int strip[6] = int[](0, 1, 5, 2, 4, 3);
    for (int i = 0; i < 6; ++i) emit(corners_cs[strip[i]]);
    EndPrimitive();
}

void main() {
    if (drawn[0] == 0u) return;
    Hull h = hull_of(volume_of(a_ws[0], b_ws[0], c_ws[0]));
    vec3 n = h.volume.normal;
    vec4 low_cs[6], high_cs[6];
    for (int k = 0; k < 6; ++k) {
        vec3 corner = hexagon_corner(h, k);
        low_cs[k] = clip_from_world * vec4(corner + h.low * n, 1.0);
        high_cs[k] = clip_from_world * vec4(corner + h.high * n, 1.0);
    }
    if (looks_away(n, h.volume.corners[0], h.high)) emit_cap(high_cs);
    if (looks_away(-n, h.volume.corners[0], -h.low)) emit_cap(low_cs);
    for (int k = 0; k < 6; ++k) {
        if (!looks_away(side_normal(h, k), h.volume.corners[k >> 1], h.reach)) continue;
        int next = (k + 1) % 6;
        emit(low_cs[k]);
        emit(low_cs[next]);
        emit(high_cs[k]);
        emit(high_cs[next]);
        EndPrimitive();
    }
}
