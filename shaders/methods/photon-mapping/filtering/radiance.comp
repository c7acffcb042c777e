// What the eye sees: with INDIRECT the reflection of the filtered irradiance, with DIRECT that of the lights,
// with EMISSION what shines by itself, with SEEN sources that are no surfaces. MATERIALS: as Transport::Materials counts.  [Smal19 eq. 7.9]
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

/// What the interface above a Lambert surface leaves of light from the mean direction; where that is unknown,
/// at normal incidence.  [glTF2 B.3.5]
vec3 below_interface(ivec2 pixel, vec3 base_colour, vec4 material) {
    int index = int(clamp(material.w + 0.5, 0.0, float(materials.length() - 1)));
    vec3 f0 = mix(vec3(dielectric_f0(materials[index].ior)), base_colour, material.x);
    vec3 l = mean_direction(pixel);
    if (!directional || l == vec3(0)) return 1.0 - f0;
    vec4 position = texelFetch(gbuffer_position, pixel, 0);
    vec3 v = view_axis_ws == vec3(0) ? (eye_ws - position.xyz) / position.w : -view_axis_ws;
    vec3 sum = l + v;
    float size = length(sum);
    return size > 0.0 ? 1.0 - schlick_fresnel(f0, clamp(dot(v, sum / size), 0.0, 1.0)) : 1.0 - f0;
}

/// Reflectance of the Lambert part: that of receivers, which their highlights are not part of.
vec3 diffuse_reflectance(ivec2 pixel) {
    vec4 albedo = texelFetch(gbuffer_albedo, pixel, 0), material = texelFetch(gbuffer_material, pixel, 0);
    if (material.z > 0.5) return vec3(0);  // unlit
#if MATERIALS == 2
    return albedo.rgb;
#else
    vec3 base = (1.0 - material.x) * (1.0 - albedo.a * (1.0 - material.x)) * albedo.rgb;
#if MATERIALS == 0
    base *= below_interface(pixel, albedo.rgb, material);
#endif
    return base;
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, first_row);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 radiance = background;
    if (texelFetch(gbuffer_geometric_normal, pixel, 0).xyz != vec3(0)) {
        radiance = vec3(0);
#ifdef INDIRECT
        radiance += diffuse_reflectance(pixel) / PI * shaded_irradiance(pixel);
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
