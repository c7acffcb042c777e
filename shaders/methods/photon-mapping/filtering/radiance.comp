// What the eye sees: with INDIRECT the reflection of the filtered irradiance, with DIRECT that of the lights,
// with EMISSION what shines by itself, with SEEN sources that are no surfaces. MATERIALS: as Transport::Materials
// counts. RECEIVER: 0 diffuse, 1 with highlights of the mean direction, 2 of directions about it.  [Smal19 eq. 7.9]
layout(local_size_x = 16, local_size_y = 16) in;

#include "lib/brdf.glsl"
#include "lib/material.glsl"
#include "methods/photon-mapping/filtering/directional.glsl"

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_material;
uniform sampler2D gbuffer_position;
uniform sampler2D direct_image;
uniform sampler2D gbuffer_emission;
uniform sampler2D seen_image;
layout(std430) readonly buffer Materials { Material materials[]; };
layout(rgba32f) uniform writeonly image2D result;

uniform int first_row;
uniform vec3 eye_ws;
uniform vec3 view_axis_ws;  // of an orthographic view; 0 for a perspective one
uniform vec3 background;    // W/(m² sr)

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
#if MATERIALS == 0
    base *= below_interface(r);
#endif
    return base;
#endif
}

#if RECEIVER > 0 && MATERIALS < 2
/// α² of the microfacets: the light's own, with RECEIVER 2 widened by the spread of the light. Its concentration κ
/// is that of directions whose mean has this length [Banerjee05 eq. 4.4]; half vectors turn half as far as directions,
/// so that their variance along each axis is 1/(4κ), and α² is twice the variance of slopes.
float squared_alpha(Receiver r, float mean_length) {
    float alpha = max(r.roughness * r.roughness, MIRROR_ALPHA);
#if RECEIVER == 2
    float squared = mean_length * mean_length;
    float inverse_kappa = (1.0 - squared) / max(mean_length * (3.0 - squared), 1e-4);
    return min(alpha * alpha + 0.5 * inverse_kappa, 1.0);
#else
    return alpha * alpha;
#endif
}

/// f of the interface, as if all light came from the mean direction, 1/sr.  [Smal19 §8.3]
vec3 specular_brdf(Receiver r, vec3 n, float mean_length) {
    if (r.l == vec3(0) || dot(n, r.l) <= 0.0) return vec3(0);
    vec3 h = normalize(r.l + r.v);
    vec3 fresnel = schlick_fresnel(r.f0, clamp(dot(r.v, h), 0.0, 1.0));
    float alpha = sqrt(squared_alpha(r, mean_length));
#if MATERIALS == 0
    return r.opaque * fresnel * gltf_microfacets(alpha, n, r.l, r.v, h);
#else
    return r.opaque * r.metallic * fresnel * blended_microfacets(alpha, n, r.l, r.v, h);
#endif
}
#endif

vec3 reflected(ivec2 pixel) {
    if (texelFetch(gbuffer_material, pixel, 0).z > 0.5) return vec3(0);  // unlit
    Receiver r = receiver_at(pixel);
    vec3 f = diffuse_reflectance(r) / PI;
#if RECEIVER > 0 && MATERIALS < 2
    f += specular_brdf(r, shading_normal(pixel), coherence(pixel));
#endif
    return f * shaded_irradiance(pixel);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, first_row);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 radiance = background;
    if (texelFetch(gbuffer_geometric_normal, pixel, 0).xyz != vec3(0)) {
        radiance = vec3(0);
#ifdef INDIRECT
        radiance += reflected(pixel);
#endif
#ifdef DIRECT
        radiance += texelFetch(direct_image, pixel, 0).rgb;
#endif
#ifdef EMISSION
        radiance += texelFetch(gbuffer_emission, pixel, 0).rgb;
#endif
    }
#ifdef SEEN
    radiance += texelFetch(seen_image, pixel, 0).rgb;
#endif
    imageStore(result, pixel, vec4(radiance, 1));
}
