// Adds the light that some samples' occluders send to each pixel's. [Ritschel09 §3.2]
layout(local_size_x = 8, local_size_y = 8) in;
#include "methods/ssdo/samples.glsl"

layout(rgba32f) uniform image2D indirect;  // A: how many occluders sent

uniform int first_sample, end_sample;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(indirect)))) return;
    vec4 sum = first_sample == 0 ? vec4(0.0) : imageLoad(indirect, pixel);
    Point x = point_at(pixel);
    if (x.exists)
        for (int i = first_sample; i < end_sample; ++i) {
            Sample s = sender_sample_of(x, i);
            sum += sent_by(x, s);
        }
    imageStore(indirect, pixel, sum);
}
