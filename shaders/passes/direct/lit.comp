// Direct light, emission, and a constant ambient radiance that accessibility attenuates.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D accessibility;
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
        // ∫ f V L_a cosθ dω = ρ L_a AO for a diffuse surface
        float open = texelFetch(accessibility, pixel, 0).x;
        radiance = texelFetch(direct, pixel, 0).rgb + texelFetch(gbuffer_emission, pixel, 0).rgb +
                   texelFetch(gbuffer_albedo, pixel, 0).rgb * ambient * open;
    }
    imageStore(lit, pixel, vec4(radiance, 1.0));
}
