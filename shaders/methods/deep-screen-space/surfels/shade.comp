// Direct light that surfels send on, on both sides. [Nalbach15 §4.3, fig. 6 d]
// What they emit is no part of it: that is direct light where it arrives. EXTENDED: of sources with an extent, too.
// MATERIALS: as Transport::Materials counts.
layout(local_size_x = 64) in;
#include "lib/floats.glsl"
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/surfels/parts.glsl"
#include "methods/deep-screen-space/surfels/sent.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
#if EXTENDED
layout(std430) readonly buffer SurfelIrradiance { SurfelLight surfel_irradiance[]; };
#endif
layout(std430) readonly buffer Stored { uint stored, made; };
layout(std430) writeonly buffer SurfelLights { SurfelLight surfel_lights[]; };
layout(std430) writeonly buffer LitCount { uint lit_count; };

void main() {
    uint item = item_of_part();
    if (item == 0u) lit_count = made;
    if (item >= min(stored, uint(surfel_lights.length()))) return;
    Surfel surfel = surfels[item];
    vec2 weights = unpackUnorm2x16(surfel.barycentrics);
    vec3 extended[2] = vec3[2](vec3(0), vec3(0));
#if EXTENDED
    for (int i = 0; i < 2; ++i) extended[i] = light_of_side(surfel_irradiance[item], i == 0);
#endif
    HitSurface side = hit_surface(surfel.triangle, weights.x, weights.y, -surfel.normal_ws, normal_maps != 0);
    surfel_lights[item].front = floats(reflected(side, surfel.centre_ws, surfel.radius, extended[0]));
    side.geometric_normal_ws = -side.geometric_normal_ws;
    side.shading_normal_ws = -side.shading_normal_ws;
    surfel_lights[item].back = floats(reflected(side, surfel.centre_ws, surfel.radius, extended[1]));
}
