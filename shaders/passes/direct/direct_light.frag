// Direct light of every light without extent at the pixel's surface, reflected to the eye; EXTENDED: and what was
// sampled of those with one. MATERIALS: as Transport::Materials counts.

#ifndef MATERIALS
#define MATERIALS 0
#endif
#include "lib/brdf.glsl"
#include "lib/material.glsl"
#include "passes/shadow/shadow.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };
layout(std430) readonly buffer Lights { Light lights[]; };

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_material;

#ifdef EXTENDED
uniform sampler2D extended_light;  // W/(m² sr)
#endif

uniform int light_count, shadow_filter_radius;
uniform vec3 eye_ws;
uniform vec3 view_axis_ws;  // of an orthographic view; 0 for a perspective one

layout(location = 0) out vec4 radiance;

vec3 brdf(Surface surface, vec3 n, vec3 l, vec3 v) {
#if MATERIALS == 0
    return gltf_brdf(surface, n, l, v);
#elif MATERIALS == 1
    return metalness_blend_brdf(surface, n, l, v);
#else
    return lambert_brdf(surface);
#endif
}

vec3 reflected(Light light, Surface surface, vec3 position_ws, vec3 n, vec3 geometric_n, vec3 v) {
    PunctualArrival light_in = punctual_arrival(light, position_ws);
    float cosine = dot(n, light_in.direction_ws);
    if (cosine <= 0.0 || dot(geometric_n, light_in.direction_ws) <= 0.0 || light_in.irradiance == vec3(0))
        return vec3(0);
    vec3 visible = shadow_visibility(light, position_ws, geometric_n, light_in.direction_ws, shadow_filter_radius);
    if (visible == vec3(0)) return vec3(0);
    return brdf(surface, n, light_in.direction_ws, v) * light_in.irradiance * cosine * visible;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(gbuffer_position, pixel, 0);
    radiance = vec4(0);
    if (position.w == 0.0) return;
    vec4 albedo = texelFetch(gbuffer_albedo, pixel, 0);
    vec4 material = texelFetch(gbuffer_material, pixel, 0);
    if (material.z > 0.5) {  // an unlit material is its colour  [glTF2 KHR_materials_unlit]
        radiance = vec4(albedo.rgb, 0);
        return;
    }
    vec3 n = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
    vec3 geometric_n = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    vec3 v = view_axis_ws == vec3(0) ? (eye_ws - position.xyz) / position.w : -view_axis_ws;
    int index = int(clamp(material.w + 0.5, 0.0, float(materials.length() - 1)));  // a half float: rounded above 2048
    Surface surface = Surface(albedo.rgb, material.x, material.y, materials[index].ior);
    for (int i = 0; i < light_count; ++i)
        if (is_punctual(lights[i]))
            radiance.rgb += reflected(lights[i], surface, position.xyz, n, geometric_n, v);
#ifdef EXTENDED
    radiance.rgb += texelFetch(extended_light, pixel, 0).rgb;
#endif
}
