// AO(x) = Σ V cosθ / Σ cosθ [Aalund15 eq. 2, divided by the discrete Σ cosθ · 2/N so that an open plane has
// exactly 1], and with PROGRESSIVE the mean over frames.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D sums;
uniform sampler2D previous;  // mean, frames
layout(r32f) uniform writeonly image2D accessibility;
#ifdef PROGRESSIVE
layout(rg32f) uniform writeonly image2D average;
uniform bool continues;
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(accessibility)))) return;
    vec2 sum = texelFetch(sums, pixel, 0).xy;
    float open = sum.y > 0.0 ? sum.x / sum.y : 1.0;
#ifdef PROGRESSIVE
    vec2 before = continues ? texelFetch(previous, pixel, 0).xy : vec2(0.0);
    open = before.x + (open - before.x) / (before.y + 1.0);
    imageStore(average, pixel, vec4(open, before.y + 1.0, 0.0, 0.0));
#endif
    imageStore(accessibility, pixel, vec4(open));
}
