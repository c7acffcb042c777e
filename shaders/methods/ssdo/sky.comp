// Adds some samples' light from the environment, openness and loss to each pixel's. [Ritschel09 §3.1]
layout(local_size_x = 8, local_size_y = 8) in;
#include "methods/ssdo/samples.glsl"

layout(rgba32f) uniform image2D sky;
layout(r32f) uniform image2D accessibility;
layout(r32f) uniform image2D cut;

uniform int first_sample, end_sample;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(sky)))) return;
    bool first = first_sample == 0;
    vec3 light = first ? vec3(0.0) : imageLoad(sky, pixel).rgb;
    float closed = first ? 0.0 : 1.0 - imageLoad(accessibility, pixel).x;
    float outside = first ? 0.0 : imageLoad(cut, pixel).x;
    Point x = point_at(pixel);
    if (x.exists)
        for (int i = first_sample; i < end_sample; ++i) {
            Sample s = sky_sample_of(x, i);
            light += sky_of(x, s);
            if (s.is_occluded) closed += dot(x.geometric_normal, s.direction) / all_cosines(x);
            if (s.is_outside) outside += 1.0 / float(params.samples);
        }
    imageStore(sky, pixel, vec4(light, 1.0));
    imageStore(accessibility, pixel, vec4(1.0 - closed));
    imageStore(cut, pixel, vec4(outside));
}
