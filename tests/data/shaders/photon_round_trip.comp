// Packs and unpacks a photon's power and direction, for the tests of records.glsl.
layout(local_size_x = 64) in;
#include "methods/photon-mapping/records.glsl"

struct Trip {
    vec3 power;
    uint power_bits;
    vec3 direction;
    uint direction_bits;
    vec3 power_out;
    uint below;
    vec3 direction_out;
    uint unused;
};
layout(std430) buffer Trips { Trip trips[]; };

uniform uint first_item, end_item;

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i >= end_item) return;
    bool below;
    uint power = packed_power(trips[i].power), direction = packed_stereographic(trips[i].direction, below);
    trips[i].power_bits = power;
    trips[i].direction_bits = direction;
    trips[i].power_out = unpacked_power(power);
    trips[i].below = uint(below);
    trips[i].direction_out = unpacked_stereographic(direction, below);
}
