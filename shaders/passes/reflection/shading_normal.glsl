// From the surface on which photons are counted to the surface as it is shaded.

uniform sampler2D gbuffer_normal;

uniform float max_stretch;
uniform bool directional;

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
