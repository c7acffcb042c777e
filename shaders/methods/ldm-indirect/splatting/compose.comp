// What the eye sees: SPLATTED light, GLOSS, DIRECT_LIGHT by rasterisation, that of the SKY by maps, the colour of UNLIT
// surfaces, EMISSION, and sources that are SEEN and no surfaces.
layout(local_size_x = 16, local_size_y = 16) in;

#include "passes/reflection/reflection.glsl"

uniform sampler2D gbuffer_emission;
uniform sampler2D direct_image;
uniform sampler2D sky_image;
uniform sampler2D gloss_image;
uniform sampler2D seen_image;
layout(rgba32f) uniform writeonly image2D radiance_image;
layout(rgba32f) uniform writeonly image2D indirect_image;

uniform vec3 background;  // W/(m² sr)

/// Of the material's diffuse part, as if nothing lay above it.
vec3 sky_reflectance(vec4 albedo, vec4 material) {
    if (material.z > 0.5) return vec3(0);  // unlit
#if MATERIALS == 2
    return albedo.rgb;
#else
    float dielectric = 1.0 - material.x;
    return dielectric * (1.0 - albedo.a * dielectric) * albedo.rgb;  // albedo.a: transmission
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(radiance_image)))) return;
    vec3 radiance = background, indirect = vec3(0);
    if (texelFetch(gbuffer_geometric_normal, pixel, 0).xyz != vec3(0)) {
        radiance = vec3(0);
        vec4 albedo = texelFetch(gbuffer_albedo, pixel, 0);
        vec4 material = texelFetch(gbuffer_material, pixel, 0);
#ifdef SPLATTED
        indirect = reflected(pixel);
#endif
#ifdef GLOSS
        indirect += texelFetch(gloss_image, pixel, 0).rgb;
#endif
        radiance += indirect;
#ifdef DIRECT_LIGHT
        radiance += texelFetch(direct_image, pixel, 0).rgb;
#endif
#ifdef SKY
        radiance += sky_reflectance(albedo, material) * texelFetch(sky_image, pixel, 0).rgb;
#endif
#ifdef UNLIT
        if (material.z > 0.5) radiance += albedo.rgb;
#endif
#ifdef EMISSION
        radiance += texelFetch(gbuffer_emission, pixel, 0).rgb;
#endif
    }
#ifdef SEEN
    radiance += texelFetch(seen_image, pixel, 0).rgb;
#endif
    imageStore(radiance_image, pixel, vec4(radiance, 1));
    imageStore(indirect_image, pixel, vec4(indirect, 1));
}
