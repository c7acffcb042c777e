// Before points compete: no element anywhere, and the depths behind which points are hidden.
#include "passes/viewers/layer.glsl"
#include "passes/viewers/project.glsl"
#include "passes/viewers/points.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D depth_behind;  // of what was drawn before

float depth_at(ivec2 sample_px) {
    return texelFetch(depth_behind, clamp(sample_px, ivec2(0), ivec2(size_px) - 1), 0).r;
}

// How much depth changes from this sample to the next on its own surface: the smaller difference, since an
// edge has another surface on one side only.
float slope(ivec2 sample_px, ivec2 step_px) {
    float here = depth_at(sample_px);
    return min(abs(depth_at(sample_px + step_px) - here), abs(depth_at(sample_px - step_px) - here));
}

void main() {
    ivec2 sample_px = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(sample_px, ivec2(size_px)))) return;
    uint at = uint(sample_px.y) * uint(size_px.x) + uint(sample_px.x);
    // A point on a sloping surface is a disc that faces the viewer: its edge is as deep in the surface as the
    // surface rises over the disc's radius.
    float rise = (point_radius() + 0.5) * (slope(sample_px, ivec2(1, 0)) + slope(sample_px, ivec2(0, 1)));
    nearest_elements[at] = 0u;
    // one less, so that a point at this very depth is in front
    nearest_keys[at] = ~floatBitsToUint(min(1.0, depth_at(sample_px) + rise)) - 1u;
}
