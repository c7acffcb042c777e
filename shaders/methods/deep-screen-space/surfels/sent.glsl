// What a surfel sends to all directions of one side alike. What it emits is no part of it: that is direct light where
// it arrives. MATERIALS: as Transport::Materials counts.
#include "passes/scene/hit_surface.glsl"
#include "lib/brdf.glsl"
#include "passes/shadow/shadow.glsl"

/// Albedo of the Lambert part, below its interface; unlit surfaces reflect nothing. [glTF2 B.3.5]
vec3 diffuse_albedo(HitSurface s) {
    if (s.is_unlit) return vec3(0);
#if MATERIALS == 2
    return s.base_colour;
#else
    return (1.0 - s.metallic) * (1.0 - s.transmission * (1.0 - s.metallic)) * s.base_colour;
#endif
}

/// What the interface lets through, both ways, towards the normal: the Lambert part of glTF depends on the
/// direction of view, by a few per cent of it as long as neither direction grazes.
vec3 below_interface(HitSurface s, vec3 to_light_ws) {
#if MATERIALS == 0
    vec3 f0 = layered_f0(s.ior, s.base_colour, s.metallic);
    vec3 n = s.shading_normal_ws, h = half_vector(n, to_light_ws, n);
    return 1.0 - schlick_fresnel(f0, clamp(dot(n, h), 0.0, 1.0));
#else
    return vec3(1);
#endif
}

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
