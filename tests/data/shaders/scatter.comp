// Scatters light that comes from one direction many times, for the tests of scattering.glsl and glass.glsl.
layout(local_size_x = 64) in;
#include "lib/random.glsl"
#include "lib/glass.glsl"

struct Draw {
    float direction[3], weight[3];
    uint is_specular, is_transmitted;
};
layout(std430) buffer Draws { Draw draws[]; };

uniform uint first_item, end_item;
uniform int model, sampling;
uniform vec3 normal, geometric_normal, base_colour, seen;
uniform float metallic, roughness;
uniform float transmission, thickness, ior;
uniform bool is_front, of_photons;

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i >= end_item) return;
    Scatterer s = make_scatterer(normal, geometric_normal, base_colour, metallic, roughness, ior, model);
    Glass glass = make_glass(transmission, ior, thickness, base_colour, is_front);
    vec4 random = unit_float(pcg4d(uvec4(i, 7u, 11u, 13u)));
    Scattered scattered = of_photons ? scatter_photon(s, glass, seen, random.x, random.yz, sampling)
                                     : scatter(s, glass, seen, random.x, random.yz, sampling);
    draws[i] = Draw(float[3](scattered.direction_ws.x, scattered.direction_ws.y, scattered.direction_ws.z),
                    float[3](scattered.weight.r, scattered.weight.g, scattered.weight.b),
                    uint(scattered.is_specular), uint(scattered.is_transmitted));
}
