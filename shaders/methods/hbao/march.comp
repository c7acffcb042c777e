// Adds some directions to each pixel's sums. [Bavoil08]
layout(local_size_x = 8, local_size_y = 8) in;
#include "methods/hbao/march.glsl"

layout(rgba32f) uniform image2D sums;  // open weight, all weight, directions cut off, samples

uniform int first_direction, end_direction;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(sums)))) return;
    vec4 sum = first_direction == 0 ? vec4(0.0) : imageLoad(sums, pixel);
    Point x = point_at(pixel);
    if (x.exists)
        for (int i = first_direction; i < end_direction; ++i) {
            Slice slice = slice_of(x, i);
            float horizon = first_horizon(slice), open = weight_up_to(slice, horizon), closed = 0.0;
            float above = open;
            for (int step = 0; step < slice.steps; ++step) {
                Sample s = sample_of(x, slice, step);
                if (!s.counts || s.angle >= horizon) continue;
                horizon = s.angle;
                float still_above = weight_up_to(slice, horizon);
                closed += occlusion(s.distance) * (above - still_above);
                above = still_above;
            }
            sum += vec4(open - closed, whole_weight(slice), slice.cut ? 1.0 : 0.0, float(slice.steps));
        }
    imageStore(sums, pixel, sum);
}
