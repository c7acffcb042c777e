// Direct light, emission, and a constant ambient radiance that accessibility attenuates, or the environment (SKY).
layout(local_size_x = 8, local_size_y = 8) in;

#ifdef SKY
uniform sampler2D sky;  // reflected by a white surface
#else
uniform sampler2D accessibility;
#endif
uniform sampler2D direct;
uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_emission;
uniform sampler2D gbuffer_geometric_normal;
layout(rgba32f) uniform writeonly image2D lit;

uniform float ambient;  // W/(m² sr)

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(lit)))) return;
    vec3 radiance = vec3(0.0);
    if (texelFetch(gbuffer_geometric_normal, pixel, 0).xyz != vec3(0.0)) {
#ifdef SKY
        vec3 around = texelFetch(sky, pixel, 0).rgb;
#else
        // ∫ f V L_a cosθ dω = ρ L_a AO for a diffuse surface
        vec3 around = vec3(ambient * texelFetch(accessibility, pixel, 0).x);
#endif
        radiance = texelFetch(direct, pixel, 0).rgb + texelFetch(gbuffer_emission, pixel, 0).rgb +
                   texelFetch(gbuffer_albedo, pixel, 0).rgb * around;
    }
    imageStore(lit, pixel, vec4(radiance, 1.0));
}
