// One surface of glass before what the G-buffer shows: the logarithm of the part of the light that it lets straight
// through. Blending adds up. What it reflects is left out, and rays are not bent.

#include "passes/gbuffer/surface.glsl"
#include "lib/brdf.glsl"

uniform sampler2D gbuffer_position;

layout(location = 0) out vec4 out_glass;  // a: 1, which counts
layout(location = 1) out float out_valid;

const float MIN_TRANSMITTED = 1e-6;  // keeps logarithms finite

/// Along the view ray, whose direction has unit length.
float distance_to(vec3 point_ws, vec3 direction) { return dot(point_ws - eye_ws, direction); }

/// Along the ray from this surface to what lies behind: a front face adds it, a back face takes it off again.
/// [glTF2 KHR_materials_volume]
vec3 log_attenuation(Material material, vec3 position_ws, vec3 direction, bool is_front) {
    if (material.thickness <= 0.0 || material.attenuation_distance <= 0.0) return vec3(0);
    vec4 behind = texelFetch(gbuffer_position, ivec2(gl_FragCoord.xy), 0);
    float end = behind.w > 0.0 ? distance_to(behind.xyz, direction) : 0.0;
    float thickness = end - distance_to(position_ws, direction);
    return log(max(material.attenuation_colour, MIN_TRANSMITTED)) * ((is_front ? thickness : -thickness) / material.attenuation_distance);
}

float reflectance(Material material, float cosine) {
    float of_interface = dielectric_fresnel(cosine, material.ior);
    return material.thickness > 0.0 ? of_interface : sheet_reflectance(of_interface);
}

void main() {
    Material material = materials[material_index];
    vec3 direction = pixel_ray_direction(gl_FragCoord.xy);
    vec3 position_ws = position_on_plane(direction);
    direction = normalize(direction);
    bool is_front = dot(plane_normal_ws, direction) <= 0.0;
    vec3 n = shading_normal(material, is_front ? plane_normal_ws : -plane_normal_ws);
    float cosine = max(-dot(n, direction), 1e-4);
    float glass = glass_fraction(material, metallic_roughness(material).x);
    vec3 through = base_colour(material).rgb * glass * (1.0 - reflectance(material, cosine));
    out_glass = vec4(log(max(through, MIN_TRANSMITTED)) + log_attenuation(material, position_ws, direction, is_front), 1);
    out_valid = 0.0;
    if (!is_seen_through(glass, emission(material)) || has_hole_here()) discard;
}
