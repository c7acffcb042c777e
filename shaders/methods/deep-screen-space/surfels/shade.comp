// Direct light that surfels send on, on both sides. [Nalbach15 §4.3, fig. 6 d]
// EMITS: and what they emit. MATERIALS: as Transport::Materials counts.
layout(local_size_x = 64) in;
#include "lib/floats.glsl"
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/surfels/parts.glsl"
#include "methods/deep-screen-space/surfels/sent.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) readonly buffer Stored { uint stored, made; };
layout(std430) writeonly buffer SurfelLights { SurfelLight surfel_lights[]; };
layout(std430) writeonly buffer LitCount { uint lit_count; };

void main() {
    uint item = item_of_part();
    if (item == 0u) lit_count = made;
    if (item >= min(stored, uint(surfel_lights.length()))) return;
    Surfel surfel = surfels[item];
    vec2 weights = unpackUnorm2x16(surfel.barycentrics);
    vec3 emission = vec3(0);
#if EMITS
    emission = emitted(surfel.triangle, weights);
#endif
    HitSurface side = hit_surface(surfel.triangle, weights.x, weights.y, -surfel.normal_ws, normal_maps != 0);
    surfel_lights[item].front = floats(emission + reflected(side, surfel.centre_ws, surfel.radius));
    side.geometric_normal_ws = -side.geometric_normal_ws;
    side.shading_normal_ws = -side.shading_normal_ws;
    surfel_lights[item].back = floats(emission + reflected(side, surfel.centre_ws, surfel.radius));
}
