// Photons with all that they have, unpacked for views.
layout(local_size_x = 64) in;

#include "lib/floats.glsl"
#include "methods/photon-mapping/records.glsl"

// C++: ir::methods::photon_mapping::PhotonLocation
struct Location {
    float position[3], normal[3], direction[3], power[3];
    float ray_length;
    uint bounce, light, seed;
};
layout(std430) readonly buffer Records { Photon records[]; };
layout(std430) readonly buffer RecordCount { uint record_count; };
layout(std430) writeonly buffer Locations { Location locations[]; };
layout(std430) buffer LocationCount { uint location_count; };

uniform uint first_item, end_item, capacity;
uniform float power_unit;


void main() {
    uint index = first_item + gl_GlobalInvocationID.x;
    uint shown = min(record_count, end_item);
    if (index == first_item) atomicMax(location_count, record_count);
    if (index >= shown || index >= capacity) return;
    Photon photon = records[index];
    locations[index] =
        Location(floats(photon.position_ws), floats(normal_of(photon)), floats(direction_of(photon)),
                 floats(power_unit * unpacked_power(photon.power)), photon.ray_length, bounce_of(photon),
                 light_of(photon), photon.bits >> 12u);
}
