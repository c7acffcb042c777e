// Σ V cosθ L / Σ cosθ, and with PROGRESSIVE the mean over frames.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D sums;
layout(rgba32f) uniform writeonly image2D light;
#ifdef PROGRESSIVE
uniform sampler2D previous;
#endif
uniform bool continues;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(light)))) return;
    vec4 sum = texelFetch(sums, pixel, 0);
    vec4 mean = vec4(sum.a > 0.0 ? sum.rgb / sum.a : vec3(0), 1);
#ifdef PROGRESSIVE
    vec4 before = continues ? texelFetch(previous, pixel, 0) : vec4(0);
    mean = vec4(before.rgb + (mean.rgb - before.rgb) / (before.a + 1.0), before.a + 1.0);
#endif
    imageStore(light, pixel, mean);
}
