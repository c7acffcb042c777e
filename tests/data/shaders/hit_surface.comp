// Looks surfaces up at hits, for the tests of hit_surface.glsl.
layout(local_size_x = 64) in;
#include "passes/scene/hit_surface.glsl"

struct Question {
    uint triangle;
    float u, v, x, y, z;
};
struct Answer {
    float position[3], geometric[3], shading[3], base_colour[3];
    float metallic, roughness, transmission, ior;
    uint material, is_front, is_unlit;
};
layout(std430) readonly buffer Questions { Question questions[]; };
layout(std430) buffer Answers { Answer answers[]; };
uniform uint questions_requested;
uniform bool normal_maps;

float[3] floats(vec3 v) { return float[3](v.x, v.y, v.z); }

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= questions_requested) return;
    Question q = questions[i];
    HitSurface s = hit_surface(q.triangle, q.u, q.v, vec3(q.x, q.y, q.z), normal_maps);
    answers[i] = Answer(floats(s.position_ws), floats(s.geometric_normal_ws), floats(s.shading_normal_ws),
                        floats(s.base_colour), s.metallic, s.roughness, s.transmission, s.ior, s.material,
                        uint(s.is_front), uint(s.is_unlit));
}
