// What is known of the light's direction at a pixel. WHOLE_DIRECTION: the sum of directions is apart.

uniform sampler2D value_image;      // E; x of the sum of directions
uniform sampler2D direction_image;  // y and z of it, or all of it
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;

uniform float max_stretch;
uniform bool directional;

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

/// From the cosine with which photons arrive on the geometric surface to that with the shading normal.
/// [Smal19 §7.4] follows the text: eq. 7.10 has the two normals in each other's place.
/// DEVIATION [Smal19 eq. 7.10]: 1 + (ω·n_s - ω·n_g) min(1/(ω·n_g), s_max), which equals the product
/// ω·n_s min(1/(ω·n_g), s_max) as long as the bound does not act. Where it does, the product takes light from
/// surfaces that have no normal map: half of it at 80 degrees and s_max = 3.
float directional_factor(vec3 direction, vec3 shading_n, vec3 geometric_n) {
    float mapped = dot(direction, shading_n), plain = dot(direction, geometric_n);
    float inverse = plain * max_stretch > 1.0 ? 1.0 / plain : max_stretch;
    return max(1.0 + (mapped - plain) * inverse, 0.0);
}

vec3 shading_normal(ivec2 pixel) {
    vec3 n = texelFetch(gbuffer_normal, pixel, 0).xyz;
    return n == vec3(0) ? n : normalize(n);
}

/// E on the surface as it is shaded, W/m².
vec3 shaded_irradiance(ivec2 pixel) {
    vec3 e = max(texelFetch(value_image, pixel, 0).rgb, vec3(0));
    if (!directional) return e;
    return e * directional_factor(mean_direction(pixel), shading_normal(pixel),
                                  texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
}
