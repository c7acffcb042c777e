// How a surface that is seen reflects light of which a pixel knows irradiance and mean direction. MATERIALS: as
// Transport::Materials counts. RECEIVER: 0 diffuse, 1 with highlights of the mean direction, 2 of directions about
// it. BARE: without an interface. ir::passes::Reflection has what it needs.  [Smal19 eq. 7.9, §8.3]
#include "lib/brdf.glsl"
#include "lib/material.glsl"
#include "passes/reflection/directional.glsl"

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_material;
uniform sampler2D gbuffer_position;
layout(std430) readonly buffer Materials { Material materials[]; };

uniform vec3 eye_ws;
uniform vec3 view_axis_ws;  // of an orthographic view; 0 for a perspective one

#if MATERIALS == 2
#define HIGHLIGHTS 0  // of what has no interface
#else
#define HIGHLIGHTS RECEIVER
#endif

/// A pixel's surface as a receiver.
struct Receiver {
    vec3 base_colour, f0;
    float metallic, roughness, opaque;
    vec3 l, v;  // towards the light (0: unknown) and the viewer
};

Receiver receiver_at(ivec2 pixel) {
    vec4 albedo = texelFetch(gbuffer_albedo, pixel, 0), material = texelFetch(gbuffer_material, pixel, 0);
    int index = int(clamp(material.w + 0.5, 0.0, float(materials.length() - 1)));
    Receiver r;
    r.base_colour = albedo.rgb;
    r.metallic = material.x;
    r.roughness = material.y;
    r.opaque = 1.0 - albedo.a * (1.0 - material.x);
#if MATERIALS == 0
    r.f0 = mix(vec3(dielectric_f0(materials[index].ior)), albedo.rgb, material.x);
#else
    r.f0 = albedo.rgb;
#endif
    r.l = mean_direction(pixel);
    vec4 position = texelFetch(gbuffer_position, pixel, 0);
    r.v = view_axis_ws == vec3(0) ? (eye_ws - position.xyz) / position.w : -view_axis_ws;
    return r;
}

/// What the interface above a Lambert surface leaves of light from the mean direction; where that is unknown,
/// at normal incidence.  [glTF2 B.3.5]
vec3 below_interface(Receiver r) {
    vec3 sum = r.l + r.v;
    float size = length(sum);
    if (!directional || r.l == vec3(0) || size == 0.0) return 1.0 - r.f0;
    return 1.0 - schlick_fresnel(r.f0, clamp(dot(r.v, sum / size), 0.0, 1.0));
}

/// Reflectance of the Lambert part.
vec3 diffuse_reflectance(Receiver r) {
#if MATERIALS == 2
    return r.base_colour;
#else
    vec3 base = (1.0 - r.metallic) * r.opaque * r.base_colour;
#if MATERIALS == 0 && !defined(BARE)
    base *= below_interface(r);
#endif
    return base;
#endif
}

#if HIGHLIGHTS == 1
/// Light that the interface reflects, W/(m² sr), as if all came from the mean direction.  [Smal19 §8.3]
vec3 highlight(ivec2 pixel, Receiver r) {
    vec3 n = shading_normal(pixel);
    if (r.l == vec3(0) || dot(n, r.l) <= 0.0) return vec3(0);
    vec3 h = normalize(r.l + r.v);
    vec3 fresnel = schlick_fresnel(r.f0, clamp(dot(r.v, h), 0.0, 1.0));
    float alpha = max(r.roughness * r.roughness, MIRROR_ALPHA);
#if MATERIALS == 0
    float microfacets = gltf_microfacets(alpha, n, r.l, r.v, h);
#else
    float microfacets = r.metallic * blended_microfacets(alpha, n, r.l, r.v, h);
#endif
    return r.opaque * microfacets * fresnel * shaded_irradiance(pixel);
}
#elif HIGHLIGHTS == 2
/// Concentration of the lobe that stands for a hemisphere's cosine: of directions whose mean is 2/3 long, as that of
/// light from everywhere is.
const float COSINE_KAPPA = 3.0667;

/// What normalises exp(κ (cosθ - 1)) over the sphere.
float lobe_norm(float kappa) {
    float k = max(kappa, 1e-3);
    return k / (2.0 * PI * (1.0 - exp(-2.0 * k)));
}

/// Light that the interface reflects, W/(m² sr), from directions about the mean one. The directions of photons are a
/// lobe exp(κ l·ω), with κ by the length of their mean [Banerjee05 eq. 4.4]. The radiance behind them is that lobe
/// over the cosine at the receiver, which for light from everywhere is a lobe, too: exp(a·ω), a = κ l - κ_c n. The
/// interface reflects by its directional albedo and a lobe κ_s about the mirrored view, 2/α² of half vectors warped
/// to directions [Wang09 §4]; the integral of the product of two lobes has a closed form.
vec3 highlight(ivec2 pixel, Receiver r) {
    vec3 n = shading_normal(pixel), geometric_n = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    float mean_length = clamp(coherence(pixel), 0.05, 0.9995), squared = mean_length * mean_length;
    float kappa = mean_length * (3.0 - squared) / (1.0 - squared);
    float alpha = max(r.roughness * r.roughness, MIRROR_ALPHA), cosine = clamp(dot(n, r.v), 0.05, 1.0);
    float kappa_s = 0.5 / (alpha * alpha * cosine);
    vec3 mirrored = reflect(-r.v, n), a = kappa * r.l - COSINE_KAPPA * geometric_n;
    float both = length(kappa_s * mirrored + a);
    // both - κ_s, which would lose its digits
    float gain = (dot(a, a) + 2.0 * kappa_s * dot(mirrored, a)) / (both + kappa_s);
    float radiance = lobe_norm(kappa_s) / lobe_norm(both) * lobe_norm(kappa) / lobe_norm(COSINE_KAPPA) *
                     exp(gain - kappa + COSINE_KAPPA) / PI;
    // where the light is narrow the cosine is known, and the lobe's is 1.5 times as large along the normal
    float l_cosine = dot(r.l, geometric_n);
    float lobe_cosine = PI * lobe_norm(COSINE_KAPPA) * exp(COSINE_KAPPA * (l_cosine - 1.0));
    radiance *= mix(1.0, lobe_cosine / max(l_cosine, 0.15), clamp(1.0 - COSINE_KAPPA / kappa, 0.0, 1.0));
    vec3 albedo = directional_albedo(r.f0, r.roughness, cosine);
#if MATERIALS == 1
    albedo *= r.metallic;
#endif
    return r.opaque * radiance * albedo * max(texelFetch(value_image, pixel, 0).rgb, vec3(0));
}
#endif

/// W/(m² sr) towards the viewer.
vec3 reflected(ivec2 pixel) {
    if (texelFetch(gbuffer_material, pixel, 0).z > 0.5) return vec3(0);  // unlit
    Receiver r = receiver_at(pixel);
    vec3 light = diffuse_reflectance(r) / PI * shaded_irradiance(pixel);
#if HIGHLIGHTS > 0
    light += highlight(pixel, r);
#endif
    return light;
}
