// What the eye sees: with INDIRECT the reflection of the filtered irradiance, with DIRECT that of the lights,
// with EMISSION what shines by itself, with SEEN sources that are no surfaces.  [Smal19 eq. 7.9]
layout(local_size_x = 16, local_size_y = 16) in;

#include "passes/reflection/reflection.glsl"

uniform sampler2D direct_image;
uniform sampler2D gbuffer_emission;
uniform sampler2D seen_image;
layout(rgba32f) uniform writeonly image2D result;

uniform int first_row;
uniform vec3 background;  // W/(m² sr)

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
