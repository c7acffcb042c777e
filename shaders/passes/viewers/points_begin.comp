// Before points compete: no element anywhere, and depths just behind what was drawn before.
#include "passes/viewers/layer.glsl"
#include "passes/viewers/project.glsl"
#include "passes/viewers/points.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D depth_behind;

void main() {
    ivec2 sample_px = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(sample_px, ivec2(size_px)))) return;
    uint at = uint(sample_px.y) * uint(size_px.x) + uint(sample_px.x);
    nearest_elements[at] = 0u;
    // one less, so that a point at this very depth is in front
    nearest_keys[at] = ~floatBitsToUint(texelFetch(depth_behind, sample_px, 0).r) - 1u;
}
