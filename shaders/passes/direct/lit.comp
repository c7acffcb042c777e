// Direct light, emission, and a constant ambient radiance that accessibility attenuates.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D accessibility;
layout(binding = 1) uniform sampler2D direct;
layout(binding = 2) uniform sampler2D albedo;
layout(binding = 3) uniform sampler2D emission;
layout(binding = 4) uniform sampler2D geometric_normal;
layout(binding = 0, rgba32f) uniform writeonly image2D lit;

uniform float ambient;  // W/(m² sr)

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(lit)))) return;
    vec3 radiance = vec3(0.0);
    if (texelFetch(geometric_normal, pixel, 0).xyz != vec3(0.0)) {
        // ∫ f V L_a cosθ dω = ρ L_a AO for a diffuse surface
        float open = texelFetch(accessibility, pixel, 0).x;
        radiance = texelFetch(direct, pixel, 0).rgb + texelFetch(emission, pixel, 0).rgb +
                   texelFetch(albedo, pixel, 0).rgb * ambient * open;
    }
    imageStore(lit, pixel, vec4(radiance, 1.0));
}
