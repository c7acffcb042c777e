// Surfels as people look at them.
layout(local_size_x = 64) in;
#include "lib/constants.glsl"
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/surfels/ideal.glsl"
#include "methods/deep-screen-space/surfels/parts.glsl"

// C++: ir::methods::deep_screen_space::ShownSurfel
struct ShownSurfel {
    vec3 centre_ws;
    uint surfel;
    vec3 normal_ws;
    float radius;
    vec3 radiance_front;
    uint triangle;
    vec3 radiance_back;
    float part;
};
layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) readonly buffer SurfelCount { uint surfel_count; };
layout(std430) writeonly buffer Shown { ShownSurfel shown[]; };
layout(std430) writeonly buffer ShownCount { uint shown_count; };

uniform uint capacity;

void main() {
    uint item = item_of_part();
    if (item == 0u) shown_count = surfel_count;
    if (item >= min(surfel_count, capacity)) return;
    Surfel s = surfels[item];
    float part = PI * s.radius * s.radius / ideal_area(s.centre_ws);
    shown[item] = ShownSurfel(s.centre_ws, item, s.normal_ws, s.radius, s.radiance_front, s.triangle,
                              s.radiance_back, part);
}
