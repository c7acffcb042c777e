// What the eye sees: the sum of INDIRECT light, DIRECT light and EMISSION, as far as each is asked for, the
// environment where there is no surface, and sources that are SEEN and no surfaces.
layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D indirect_image;
uniform sampler2D direct_image;
uniform sampler2D gbuffer_emission;
uniform sampler2D seen_image;
layout(rgba32f) uniform writeonly image2D radiance_image;

uniform vec3 background;  // W/(m² sr)

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(radiance_image)))) return;
    vec3 radiance = background;
    if (texelFetch(gbuffer_geometric_normal, pixel, 0).xyz != vec3(0)) {
        radiance = vec3(0);
#ifdef INDIRECT
        radiance += texelFetch(indirect_image, pixel, 0).rgb;
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
    imageStore(radiance_image, pixel, vec4(radiance, 1));
}
