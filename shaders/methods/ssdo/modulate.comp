// Takes the material's reflectance out of a picture before the blur (REMOVE), or puts it back in, so that textures
// survive the blur.
layout(local_size_x = 8, local_size_y = 8) in;

#include "lib/scattering.glsl"

uniform sampler2D from_image;
uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_material;
layout(rgba32f) uniform writeonly image2D to_image;

/// Of the Lambert part and of the microfacets at normal incidence; never 0.
vec3 reflectance(vec3 base_colour, float metallic) {
    Scatterer s = make_scatterer(vec3(0, 0, 1), vec3(0, 0, 1), base_colour, metallic, 1.0, 1.5, params.materials);
    return max(s.diffuse + s.specular * s.f0, vec3(0.02));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(to_image)))) return;
    vec4 value = texelFetch(from_image, pixel, 0);
    vec3 factor =
        reflectance(texelFetch(gbuffer_albedo, pixel, 0).rgb, texelFetch(gbuffer_material, pixel, 0).x);
#ifdef REMOVE
    value.rgb /= factor;
#else
    value.rgb *= factor;
#endif
    imageStore(to_image, pixel, value);
}
