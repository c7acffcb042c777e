// Direct light that surfels send on, on both sides. [Nalbach15 §4.3, fig. 6 d]
// What they emit is no part of it: that is direct light where it arrives. EXTENDED: of sources with an extent, too.
// MATERIALS: as Transport::Materials counts.
layout(local_size_x = 64) in;
#include "passes/scene/hit_surface.glsl"
#include "lib/brdf.glsl"
#include "lib/floats.glsl"
#include "passes/shadow/shadow.glsl"
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/surfels/parts.glsl"
#include "methods/deep-screen-space/surfels/diffuse.glsl"

layout(std430) readonly buffer Lights { Light lights[]; };
layout(std430) readonly buffer Surfels { Surfel surfels[]; };
#if EXTENDED
layout(std430) readonly buffer SurfelIrradiance { SurfelLight surfel_irradiance[]; };
#endif
layout(std430) readonly buffer Stored { uint stored, made; };
layout(std430) writeonly buffer SurfelLights { SurfelLight surfel_lights[]; };
layout(std430) writeonly buffer LitCount { uint lit_count; };

uniform int light_count, normal_maps;
uniform float light_offset;  // radii

/// `extended`: irradiance by sources with an extent, W/m². Seen from above the interface lets as much of it through as
/// of light along the normal: half-way to no direction does Fresnel's factor rise by more than 0.3 %.
vec3 reflected(HitSurface s, vec3 position_ws, float radius, vec3 extended) {
    vec3 albedo = diffuse_albedo(s), sum = vec3(0);
    if (albedo == vec3(0)) return sum;
    if (extended != vec3(0)) sum = below_interface(s, s.shading_normal_ws) * extended;
    for (int i = 0; i < light_count; ++i) {
        if (!is_punctual(lights[i])) continue;
        PunctualArrival light = punctual_arrival(lights[i], position_ws);
        float cosine = dot(s.shading_normal_ws, light.direction_ws);
        if (cosine <= 0.0 || dot(s.geometric_normal_ws, light.direction_ws) <= 0.0 || light.irradiance == vec3(0))
            continue;
        float visible = shadow_visibility(lights[i], position_ws + light_offset * radius * s.geometric_normal_ws,
                                          s.geometric_normal_ws, light.direction_ws, 0);
        sum += below_interface(s, light.direction_ws) * light.irradiance * (cosine * visible);
    }
    return albedo / PI * sum;
}

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
