// A pixel's surface as a receiver of light, and the parts of its BRDF. MATERIALS: as Transport::Materials counts.
#include "lib/brdf.glsl"
#include "lib/material.glsl"

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_material;
layout(std430) readonly buffer Materials { Material materials[]; };

struct Receiver {
    vec3 base_colour, f0;
    float metallic, roughness, opaque;
    vec3 n, v;  // shading normal, and towards the viewer
};

Receiver receiver_at(ivec2 pixel, vec3 n, vec3 v) {
    vec4 albedo = texelFetch(gbuffer_albedo, pixel, 0), material = texelFetch(gbuffer_material, pixel, 0);
    int index = int(clamp(material.w + 0.5, 0.0, float(materials.length() - 1)));
    Receiver r;
    r.base_colour = albedo.rgb;
    r.metallic = material.x;
    r.roughness = material.y;
    r.opaque = 1.0 - albedo.a * (1.0 - material.x);
#if MATERIALS == 0
    r.f0 = layered_f0(materials[index].ior, albedo.rgb, material.x);
#else
    r.f0 = albedo.rgb;
#endif
    r.n = n;
    r.v = v;
    return r;
}

/// What the interface above a Lambert surface leaves of light from l; where that is 0, unknown, at normal incidence.
/// [glTF2 B.3.5]
vec3 below_interface(Receiver r, vec3 l) {
    if (l == vec3(0)) return 1.0 - r.f0;
    return 1.0 - schlick_fresnel(r.f0, clamp(dot(r.v, half_vector(r.n, l, r.v)), 0.0, 1.0));
}

/// BRDF of the interface for light from above it, 1/sr. `alpha` is the roughness² of its microfacets.
vec3 interface_brdf(Receiver r, vec3 l, float alpha) {
    vec3 h = half_vector(r.n, l, r.v);
    vec3 fresnel = schlick_fresnel(r.f0, clamp(dot(r.v, h), 0.0, 1.0));
#if MATERIALS == 0
    float microfacets = gltf_microfacets(alpha, r.n, l, r.v, h);
#else
    float microfacets = r.metallic * blended_microfacets(alpha, r.n, l, r.v, h);
#endif
    return r.opaque * microfacets * fresnel;
}

/// Part of light from everywhere that the interface reflects.
vec3 interface_albedo(Receiver r) {
    vec3 albedo = directional_albedo(r.f0, r.roughness, clamp(dot(r.n, r.v), 0.05, 1.0));
#if MATERIALS == 1
    albedo *= r.metallic;
#endif
    return r.opaque * albedo;
}

// C++: ir::passes::least_highlight_scale
const float LEAST_HIGHLIGHT_SCALE = 0.01;

/// What the interface reflects of photons is divided by this before it is filtered, and multiplied by it afterwards:
/// so that filters do not blur materials.
vec3 highlight_scale(Receiver r) { return max(interface_albedo(r), vec3(LEAST_HIGHLIGHT_SCALE)); }
