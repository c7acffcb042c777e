// How a surface that is seen reflects light of which a pixel knows irradiance and mean direction. MATERIALS: as
// Transport::Materials counts. RECEIVER: 0 diffuse, 1 with highlights of the mean direction, 2 of directions about
// it, 3 of each photon. BARE: without an interface. ir::passes::Reflection has what it needs.  [Smal19 eq. 7.9, §8.3]
#include "passes/reflection/receiver.glsl"
#include "passes/reflection/directional.glsl"

uniform sampler2D gbuffer_position;

uniform vec3 eye_ws;
uniform vec3 view_axis_ws;  // of an orthographic view; 0 for a perspective one

#if MATERIALS == 2
#define HIGHLIGHTS 0  // of what has no interface
#else
#define HIGHLIGHTS RECEIVER
#endif

Receiver receiver_at(ivec2 pixel) {
    vec4 position = texelFetch(gbuffer_position, pixel, 0);
    vec3 v = view_axis_ws == vec3(0) ? (eye_ws - position.xyz) / position.w : -view_axis_ws;
    return receiver_at(pixel, shading_normal(pixel), v);
}

/// Reflectance of the Lambert part, below the interface, whose part of each photon is known to `full` receivers.
vec3 diffuse_reflectance(ivec2 pixel, Receiver r) {
#if MATERIALS == 2
    return r.base_colour;
#else
    vec3 base = (1.0 - r.metallic) * r.opaque * r.base_colour;
#if MATERIALS == 0 && RECEIVER != 3 && !defined(BARE)
    base *= below_interface(r, directional ? mean_direction(pixel) : vec3(0));
#endif
    return base;
#endif
}

#if HIGHLIGHTS == 1
/// Light that the interface reflects, W/(m² sr), as if all came from the mean direction.  [Smal19 §8.3]
vec3 highlight(ivec2 pixel, Receiver r) {
    vec3 l = mean_direction(pixel);
    if (l == vec3(0) || dot(r.n, l) <= 0.0) return vec3(0);
    return interface_brdf(r, l, max(r.roughness * r.roughness, MIRROR_ALPHA)) * shaded_irradiance(pixel);
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
    vec3 l = mean_direction(pixel), geometric_n = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    float mean_length = clamp(coherence(pixel), 0.05, 0.9995), squared = mean_length * mean_length;
    float kappa = mean_length * (3.0 - squared) / (1.0 - squared);
    float alpha = max(r.roughness * r.roughness, MIRROR_ALPHA), cosine = clamp(dot(r.n, r.v), 0.05, 1.0);
    float kappa_s = 0.5 / (alpha * alpha * cosine);
    vec3 mirrored = reflect(-r.v, r.n), a = kappa * l - COSINE_KAPPA * geometric_n;
    float both = length(kappa_s * mirrored + a);
    // both - κ_s, which would lose its digits
    float gain = (dot(a, a) + 2.0 * kappa_s * dot(mirrored, a)) / (both + kappa_s);
    float radiance = lobe_norm(kappa_s) / lobe_norm(both) * lobe_norm(kappa) / lobe_norm(COSINE_KAPPA) *
                     exp(gain - kappa + COSINE_KAPPA) / PI;
    // where the light is narrow the cosine is known, and the lobe's is 1.5 times as large along the normal
    float l_cosine = dot(l, geometric_n);
    float lobe_cosine = PI * lobe_norm(COSINE_KAPPA) * exp(COSINE_KAPPA * (l_cosine - 1.0));
    radiance *= mix(1.0, lobe_cosine / max(l_cosine, 0.15), clamp(1.0 - COSINE_KAPPA / kappa, 0.0, 1.0));
    return radiance * interface_albedo(r) * max(texelFetch(value_image, pixel, 0).rgb, vec3(0));
}
#elif HIGHLIGHTS == 3
/// Light that the interface reflects, W/(m² sr): the sum over photons.
vec3 highlight(ivec2 pixel, Receiver r) { return highlight_scale(r) * max(direction_sum(pixel), vec3(0)); }
#endif

/// W/(m² sr) towards the viewer.
vec3 reflected(ivec2 pixel) {
    if (texelFetch(gbuffer_material, pixel, 0).z > 0.5) return vec3(0);  // unlit
    Receiver r = receiver_at(pixel);
    vec3 light = diffuse_reflectance(pixel, r) / PI * shaded_irradiance(pixel);
#if HIGHLIGHTS > 0
    light += highlight(pixel, r);
#endif
    return light;
}
