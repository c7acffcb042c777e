// What the eye sees: SPLATTED light, DIRECT_LIGHT by rasterisation, the colour of UNLIT surfaces, EMISSION.
layout(local_size_x = 16, local_size_y = 16) in;

#include "lib/brdf.glsl"

layout(binding = 0) uniform sampler2D irradiance_image;
layout(binding = 1) uniform sampler2D geometric_normal_image;
layout(binding = 2) uniform sampler2D albedo_image;
layout(binding = 3) uniform sampler2D material_image;
layout(binding = 4) uniform sampler2D emission_image;
layout(binding = 5) uniform sampler2D direct_image;
layout(binding = 0, rgba32f) uniform writeonly image2D radiance_image;
layout(binding = 1, rgba32f) uniform writeonly image2D indirect_image;

uniform vec3 background;  // W/(m² sr)

/// ρ: the diffuse part of the material, as if nothing lay above it.
vec3 diffuse_reflectance(vec3 base_colour, vec4 material) {
    if (material.z > 0.5) return vec3(0);  // unlit
#ifdef LAMBERT
    return base_colour;
#else
    return (1.0 - material.x) * base_colour;
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(radiance_image)))) return;
    vec3 radiance = background, indirect = vec3(0);
    if (texelFetch(geometric_normal_image, pixel, 0).xyz != vec3(0)) {
        radiance = vec3(0);
        vec3 base_colour = texelFetch(albedo_image, pixel, 0).rgb;
        vec4 material = texelFetch(material_image, pixel, 0);
#ifdef SPLATTED
        // f = ρ/π [Aalund15 eq. 5]
        indirect = diffuse_reflectance(base_colour, material) / PI * texelFetch(irradiance_image, pixel, 0).rgb;
        radiance += indirect;
#endif
#ifdef DIRECT_LIGHT
        radiance += texelFetch(direct_image, pixel, 0).rgb;
#endif
#ifdef UNLIT
        if (material.z > 0.5) radiance += base_colour;
#endif
#ifdef EMISSION
        radiance += texelFetch(emission_image, pixel, 0).rgb;
#endif
    }
    imageStore(radiance_image, pixel, vec4(radiance, 1));
    imageStore(indirect_image, pixel, vec4(indirect, 1));
}
