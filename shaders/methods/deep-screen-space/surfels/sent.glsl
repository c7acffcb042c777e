// What a surfel sends to all directions of one side alike. What it emits is no part of it: that is direct light where
// it arrives. MATERIALS: as Transport::Materials counts.
#include "passes/scene/hit_surface.glsl"
#include "lib/brdf.glsl"
#include "passes/shadow/shadow.glsl"
#include "methods/deep-screen-space/surfels/diffuse.glsl"

layout(std430) readonly buffer Lights { Light lights[]; };

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
        vec3 visible = shadow_visibility(lights[i], position_ws + light_offset * radius * s.geometric_normal_ws,
                                         s.geometric_normal_ws, light.direction_ws, 0);
        sum += below_interface(s, light.direction_ws) * light.irradiance * (cosine * visible);
    }
    return albedo / PI * sum;
}
