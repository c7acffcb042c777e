// Reflection models as functions of unit vectors: n normal, l to the light, v to the viewer, h halfway. They
// return the BRDF in 1/sr without the cosine; inputs are linear.

#include "lib/constants.glsl"

/// Below this roughness² a surface is a mirror to rays. It reflects no punctual light; its highlight stays this wide.
// C++: ir::passes::mirror_alpha
const float MIRROR_ALPHA = 1e-3;
/// Least cosine to the viewer: shading normals may turn away from it.
// C++: ir::passes::min_view_cosine
const float MIN_VIEW_COSINE = 1e-4;
/// A relative index of refraction as near to 1 lets light pass straight on, whatever the microfacets.
// C++: ir::passes::same_index
const float SAME_INDEX = 1e-3;

// Models of scattering, in the order of Transport::Materials.
// C++: ir::passes::*
const int SCATTERING_GLTF = 0, SCATTERING_METALNESS_BLEND = 1, SCATTERING_LAMBERT = 2;

/// Halfway between unit l and v; the normal where they are opposite, and nothing is halfway.
vec3 half_vector(vec3 n, vec3 l, vec3 v) {
    vec3 sum = l + v;
    float size = length(sum);
    return size > 0.0 ? sum / size : n;
}

/// Microfacet distribution.  [Walter07 eq. 33]
float ggx_distribution(float n_dot_h, float alpha) {
    float squared = alpha * alpha;
    float denominator = n_dot_h * n_dot_h * (squared - 1.0) + 1.0;
    return squared / (PI * denominator * denominator);
}

/// Height-correlated Smith masking and shadowing over 4 (n·l)(n·v).  [Heitz14 eq. 99]
float smith_visibility(float n_dot_l, float n_dot_v, float alpha) {
    float squared = alpha * alpha;
    float towards_viewer = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - squared) + squared);
    float towards_light = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - squared) + squared);
    return 0.5 / max(towards_viewer + towards_light, 1e-7);
}

/// [Schlick94 eq. 15]
vec3 schlick_fresnel(vec3 f0, float v_dot_h) {
    return f0 + (1.0 - f0) * pow(clamp(1.0 - v_dot_h, 0.0, 1.0), 5.0);
}

/// ∫ f cosθ of GGX microfacets over the directions: f0 T + (1 - f0) B, without light between microfacets. Fitted to
/// values that were found by sampling; T is wrong by at most 0.03 and B by 0.06 where the cosine is 0.1 or more.
vec3 directional_albedo(vec3 f0, float roughness, float cosine) {
    vec3 powers = vec3(1, cosine, cosine * cosine);
    float squared = roughness * roughness;
    float lost = dot(powers, vec3(2.288, -5.423, 2.189)) + roughness * dot(powers, vec3(-5.015, 16.649, -8.123)) +
                 squared * dot(powers, vec3(2.892, -10.219, 5.447));
    float grazing = pow(1.0 - cosine, 5.0) * exp(-5.0 * squared);
    return f0 * clamp(1.0 - squared * lost, 0.0, 1.0) + (1.0 - f0) * grazing;
}

/// Reflectance at normal incidence from air.
float dielectric_f0(float ior) {
    float ratio = (ior - 1.0) / (ior + 1.0);
    return ratio * ratio;
}

/// The same of the interface of a layered material.  [glTF2 B.3.5]
vec3 layered_f0(float ior, vec3 base_colour, float metallic) {
    return mix(vec3(dielectric_f0(ior)), base_colour, metallic);
}

/// Of the refracted ray, by Snell's law; 0 for total internal reflection. `eta` as below.
float refracted_cosine(float cosine, float eta) {
    float squared_sine = (1.0 - cosine * cosine) / (eta * eta);
    return squared_sine < 1.0 ? sqrt(1.0 - squared_sine) : 0.0;
}

/// Reflectance of a smooth interface for unpolarised light, (r_s² + r_p²)/2. `eta`: index behind the interface over
/// that in front of it.  [glTF2 KHR_materials_ior]
float dielectric_fresnel(float cosine, float eta) {
    float refracted = refracted_cosine(cosine, eta);
    if (refracted == 0.0) return 1.0;
    float s = (cosine - eta * refracted) / (cosine + eta * refracted);
    float p = (eta * cosine - refracted) / (eta * cosine + refracted);
    return (s * s + p * p) / 2.0;
}

/// Of a plane-parallel sheet, all reflections between its two interfaces counted: 2F / (1 + F).
float sheet_reflectance(float interface_reflectance) {
    return 2.0 * interface_reflectance / (1.0 + interface_reflectance);
}

/// What a lit glTF surface is made of.
struct Surface {
    vec3 base_colour;
    float metallic, roughness, ior;
};

/// Microfacets without Fresnel reflectance; `h` halfway between l and v, above n both.
float gltf_microfacets(float alpha, vec3 n, vec3 l, vec3 v, vec3 h) {
    return ggx_distribution(clamp(dot(n, h), 0.0, 1.0), alpha) *
           smith_visibility(dot(n, l), max(dot(n, v), MIN_VIEW_COSINE), alpha);
}

/// The metallic-roughness material of glTF 2.0, Appendix B.3.5: Lambert below a GGX interface; metals have no
/// Lambert part and their colour as reflectance.  [glTF2 B.3.5]
vec3 gltf_brdf(Surface surface, vec3 n, vec3 l, vec3 v) {
    if (dot(n, l) <= 0.0) return vec3(0);
    vec3 h = half_vector(n, l, v);
    float alpha = max(surface.roughness * surface.roughness, MIRROR_ALPHA);
    vec3 f0 = layered_f0(surface.ior, surface.base_colour, surface.metallic);
    vec3 fresnel = schlick_fresnel(f0, clamp(dot(v, h), 0.0, 1.0));
    vec3 diffuse = (1.0 - fresnel) * (1.0 - surface.metallic) * surface.base_colour / PI;
    return diffuse + fresnel * gltf_microfacets(alpha, n, l, v, h);
}

/// Diffuse, whatever metallic and roughness say.
vec3 lambert_brdf(Surface surface) { return surface.base_colour / PI; }

/// Smith's masking of one direction over 2 n·v: G1 = 2 / (1 + √(1 + α² tan²θ)).  [Walter07 eq. 34]
/// DEVIATION [Smal19 eq. 3.7]: θ is the angle to the macroscopic normal, not to the half vector, with which G
/// would be no masking at all.
float smith_masking_over_2_cosine(float n_dot_v, float alpha) {
    float squared = alpha * alpha;
    return 1.0 / (n_dot_v + sqrt(squared + (1.0 - squared) * n_dot_v * n_dot_v));
}

/// The same as gltf_microfacets, with the product of two maskings.  [Smal19 eq. 3.6]
float blended_microfacets(float alpha, vec3 n, vec3 l, vec3 v, vec3 h) {
    return ggx_distribution(clamp(dot(n, h), 0.0, 1.0), alpha) * smith_masking_over_2_cosine(dot(n, l), alpha) *
           smith_masking_over_2_cosine(max(dot(n, v), MIN_VIEW_COSINE), alpha);
}

/// k f_Lambert + (1 - k) f_CookTorrance with k = 1 - metallic, and the base colour as reflectance.
/// [Smal19 eqs. 3.4-3.8]
vec3 metalness_blend_brdf(Surface surface, vec3 n, vec3 l, vec3 v) {
    if (dot(n, l) <= 0.0) return vec3(0);
    vec3 h = half_vector(n, l, v);
    float alpha = max(surface.roughness * surface.roughness, MIRROR_ALPHA);
    return (1.0 - surface.metallic) * lambert_brdf(surface) +
           surface.metallic * schlick_fresnel(surface.base_colour, clamp(dot(v, h), 0.0, 1.0)) *
               blended_microfacets(alpha, n, l, v, h);
}
