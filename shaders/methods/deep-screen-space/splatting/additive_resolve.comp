// Adds up the levels and makes the result of the sum.  [Nalbach14]
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D levels_texture[LEVELS];
#if LIGHT
uniform sampler2D glossy_texture[LEVELS];
uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_material;
#else
uniform sampler2D gbuffer_position;
#endif
uniform writeonly image2D sum_image;
uniform writeonly image2D result_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result_image)))) return;
    vec4 sum = vec4(0);
    for (int level = 0; level < LEVELS; ++level) sum += texelFetch(levels_texture[level], pixel, 0);
    imageStore(sum_image, pixel, sum);
#if LIGHT
    vec4 material = texelFetch(gbuffer_material, pixel, 0);
#if MATERIALS == 2  // SCATTERING_LAMBERT
    float diffuse = 1.0;
#else
    float diffuse = 1.0 - material.x;
#endif
    vec3 radiance = sum.rgb * diffuse * texelFetch(gbuffer_albedo, pixel, 0).rgb;
#if MATERIALS != 2
    for (int level = 0; level < LEVELS; ++level) radiance += texelFetch(glossy_texture[level], pixel, 0).rgb;
#endif
    imageStore(result_image, pixel, vec4(radiance, 1));
#else
    bool exists = texelFetch(gbuffer_position, pixel, 0).w > 0.0;
    imageStore(result_image, pixel, vec4(exists ? clamp(1.0 - sum.x, 0.0, 1.0) : 1.0));
#endif
}
