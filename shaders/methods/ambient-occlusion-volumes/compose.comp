// From the sum over all triangles to accessibility.
layout(local_size_x = 8, local_size_y = 8) in;
#include "methods/ambient-occlusion-volumes/compensation.glsl"

uniform sampler2D sums;
layout(r32f) uniform writeonly image2D raw;

/// independent: what is left of the hemisphere where many small occluders lie anywhere, e^−Σ, as if none knew of the
/// others.
float accessibility(float sum) {
    if (params.compensation == COMPENSATION_MEASURED) return measured_accessibility(sum);
    return params.compensation == COMPENSATION_INDEPENDENT ? exp(-max(sum, 0.0)) : clamp(1.0 - sum, 0.0, 1.0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(raw)))) return;
    imageStore(raw, pixel, vec4(accessibility(texelFetch(sums, pixel, 0).x)));
}
