// What glossy surfels send to one side more, or less, than they store for all: with the whole BRDF, for lights
// without extent. [Nalbach15 §3.2: "radiance from either a Lambertian or glossy sender"]
#define HIT_SURFACE_BINDING 3
#include "passes/scene/hit_surface.glsl"
#include "lib/brdf.glsl"
#define SHADOW_VIEWS 2
#define SHADOW_MAPS 2
#include "passes/shadow/shadow.glsl"
#include "methods/deep-screen-space/surfels/diffuse.glsl"

layout(std430, binding = 1) readonly buffer Lights { Light lights[]; };

uniform int light_count, normal_maps;

/// Of opaque light: what the Lambert part lets through is not reflected.
vec3 whole_brdf(HitSurface s, vec3 l, vec3 v) {
    vec3 n = s.shading_normal_ws;
    Surface surface = Surface(s.base_colour, s.metallic, s.roughness, s.ior);
    vec3 lambert = (1.0 - s.metallic) * s.base_colour / PI;
    float lost = s.transmission * (1.0 - s.metallic);
#if MATERIALS == 0
    vec3 f0 = mix(vec3(dielectric_f0(s.ior)), s.base_colour, s.metallic);
    vec3 fresnel = schlick_fresnel(f0, clamp(dot(v, normalize(l + v)), 0.0, 1.0));
    return gltf_brdf(surface, n, l, v) - lost * (1.0 - fresnel) * lambert;
#else
    return metalness_blend_brdf(surface, n, l, v) - lost * lambert;
#endif
}

/// At the surfel's centre, where what it stores was found, and from there towards the ray's origin: a point of an
/// enlarged disc need not lie on the surface.
vec3 sent_to_one_side(Surfel surfel, vec3 direction_ws) {
    vec2 weights = unpackUnorm2x16(surfel.barycentrics);
    HitSurface s = hit_surface(surfel.triangle, weights.x, weights.y, direction_ws, normal_maps != 0);
    vec3 sum = vec3(0);
    if (s.is_unlit) return sum;
    vec3 stored = diffuse_albedo(s) / PI;
    for (int i = 0; i < light_count; ++i) {
        if (!is_punctual(lights[i])) continue;
        Arrival light = arrival(lights[i], surfel.centre_ws);
        vec3 l = light.direction_ws;
        float cosine = dot(s.shading_normal_ws, l);
        if (cosine <= 0.0 || dot(s.geometric_normal_ws, l) <= 0.0 || light.irradiance == vec3(0)) continue;
        float visible = shadow_visibility(lights[i], surfel.centre_ws, s.geometric_normal_ws, l, 0);
        if (visible == 0.0) continue;
        sum += (whole_brdf(s, l, -direction_ws) - stored * below_interface(s, l)) * light.irradiance *
               (cosine * visible);
    }
    return sum;
}
