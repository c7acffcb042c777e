// What is known of the light's direction at a pixel. WHOLE_DIRECTION: the sum of directions is apart.
#include "passes/reflection/shading_normal.glsl"

uniform sampler2D value_image;      // E; x of the sum of directions
uniform sampler2D direction_image;  // y and z of it, or all of it
uniform sampler2D gbuffer_geometric_normal;

vec3 direction_sum(ivec2 pixel) {
#ifdef WHOLE_DIRECTION
    return texelFetch(direction_image, pixel, 0).xyz;
#else
    return vec3(texelFetch(value_image, pixel, 0).a, texelFetch(direction_image, pixel, 0).xy);
#endif
}

/// Unit, towards the light; 0 where nothing is known.
vec3 mean_direction(ivec2 pixel) {
    vec3 sum = direction_sum(pixel);
    float size = length(sum);
    return size > 0.0 ? sum / size : vec3(0);
}

/// Length of the mean of the directions to the light, each weighted by what comes from there; 1 where it all comes
/// from one. Clipped details may make it larger.
float coherence(ivec2 pixel) {
    float weight = dot(texelFetch(value_image, pixel, 0).rgb, vec3(1));
    return weight > 0.0 ? min(length(direction_sum(pixel)) / weight, 1.0) : 1.0;
}

/// E on the surface as it is shaded, W/m².
vec3 shaded_irradiance(ivec2 pixel) {
    vec3 e = max(texelFetch(value_image, pixel, 0).rgb, vec3(0));
    if (!directional) return e;
    return e * directional_factor(mean_direction(pixel), shading_normal(pixel),
                                  texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
}
