// Surfels as people look at them. LIT: they send light.
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
layout(std430) readonly buffer Stored { uint stored, made; };
#if LIT
layout(std430) readonly buffer SurfelLights { SurfelLight surfel_lights[]; };
#endif
layout(std430) writeonly buffer Shown { ShownSurfel shown[]; };
layout(std430) writeonly buffer ShownCount { uint shown_count; };

uniform uint capacity;

void main() {
    uint item = item_of_part();
    if (item == 0u) shown_count = made;
    if (item >= min(stored, capacity)) return;
    Surfel s = surfels[item];
    float part = PI * s.radius * s.radius / ideal_area(s.centre_ws);
    vec3 front = vec3(0), back = vec3(0);
#if LIT
    front = light_of_side(surfel_lights[item], true);
    back = light_of_side(surfel_lights[item], false);
#endif
    shown[item] = ShownSurfel(s.centre_ws, item, s.normal_ws, s.radius, front, s.triangle, back, part);
}
