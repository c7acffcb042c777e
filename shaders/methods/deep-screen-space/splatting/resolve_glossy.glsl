// What glossy surfels send to one side more, or less, than they store for all: with the whole BRDF, for lights
// without extent. Include sent.glsl before it. [Nalbach15 §3.2: "radiance from either a Lambertian or glossy
// sender"]
#include "passes/scene/highlights.glsl"

/// Of the part that is no glass. [glTF2 KHR_materials_transmission]
vec3 whole_brdf(HitSurface s, vec3 l, vec3 v) {
    Surface surface = Surface(s.base_colour, s.metallic, s.roughness, s.ior);
    float opaque = 1.0 - s.transmission * (1.0 - s.metallic);
#if MATERIALS == 0
    return opaque * gltf_brdf(surface, s.shading_normal_ws, l, v);
#else
    return opaque * metalness_blend_brdf(surface, s.shading_normal_ws, l, v);
#endif
}

/// At the surfel's centre, where what it stores was found, and from there towards the ray's origin: a point of an
/// enlarged disc need not lie on the surface. `variance`: of the half vectors' slopes.
vec3 sent_to_one_side(Surfel surfel, vec3 direction_ws, float variance) {
    vec2 weights = unpackUnorm2x16(surfel.barycentrics);
    HitSurface s = hit_surface(surfel.triangle, weights.x, weights.y, direction_ws, normal_maps != 0);
    vec3 sum = vec3(0);
    if (s.is_unlit) return sum;
    float own = s.roughness;
    s.roughness = widened_roughness(own, variance);
    float gain = widened_gain(own, s.roughness, dot(s.shading_normal_ws, -direction_ws));
    vec3 stored = diffuse_albedo(s) / PI;
    for (int i = 0; i < light_count; ++i) {
        if (!is_punctual(lights[i])) continue;
        PunctualArrival light = punctual_arrival(lights[i], surfel.centre_ws);
        vec3 l = light.direction_ws;
        float cosine = dot(s.shading_normal_ws, l);
        if (cosine <= 0.0 || dot(s.geometric_normal_ws, l) <= 0.0 || light.irradiance == vec3(0)) continue;
        vec3 visible = shadow_visibility(lights[i], surfel.centre_ws + light_offset * surfel.radius * s.geometric_normal_ws,
                                         s.geometric_normal_ws, l, 0);
        if (visible == vec3(0)) continue;
        sum += (whole_brdf(s, l, -direction_ws) - stored * below_interface(s, l)) * light.irradiance *
               (gain * cosine * visible);
    }
    return sum;
}
