// Light of sources with an extent as it is shown: the mean of the samples, or, FILTERED, the filtered light with the
// materials' reflectance put back in.
layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D unfiltered_image;
uniform sampler2D even_image;
uniform sampler2D reflectance_image;
layout(rgba32f) uniform writeonly image2D result;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
#ifdef FILTERED
    vec3 light = texelFetch(even_image, pixel, 0).rgb * texelFetch(reflectance_image, pixel, 0).rgb;
#else
    vec3 light = texelFetch(unfiltered_image, pixel, 0).rgb;
#endif
    imageStore(result, pixel, vec4(light, 1));
}
