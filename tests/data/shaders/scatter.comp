// Scatters light that comes from one direction many times, for the tests of scattering.glsl.
layout(local_size_x = 64) in;
#include "lib/random.glsl"
#include "lib/scattering.glsl"

struct Draw {
    float direction[3], weight[3];
    uint is_specular, unused;
};
layout(std430) buffer Draws { Draw draws[]; };

uniform uint first_item, end_item;
uniform int model, sampling;
uniform vec3 normal, geometric_normal, base_colour, seen;
uniform float metallic, roughness;

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i >= end_item) return;
    Scatterer s = make_scatterer(normal, geometric_normal, base_colour, metallic, roughness, 1.5, model);
    vec4 random = unit_float(pcg4d(uvec4(i, 7u, 11u, 13u)));
    Scattered scattered = scatter(s, seen, random.x, random.yz, sampling);
    draws[i] = Draw(float[3](scattered.direction_ws.x, scattered.direction_ws.y, scattered.direction_ws.z),
                    float[3](scattered.weight.r, scattered.weight.g, scattered.weight.b),
                    uint(scattered.is_specular), 0u);
}
