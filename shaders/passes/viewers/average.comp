// Each pixel as the mean of oversampling² samples; layer and element are those of the sample in its middle.

layout(local_size_x = 16, local_size_y = 16) in;
layout(rgba32f) writeonly uniform image2D colours;
layout(rg32ui) writeonly uniform uimage2D ids;

uniform sampler2D colour_samples;
uniform usampler2D id_samples;
uniform int oversampling;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), first = oversampling * pixel;
    if (any(greaterThanEqual(first, textureSize(colour_samples, 0)))) return;
    vec3 sum = vec3(0);
    for (int y = 0; y < oversampling; ++y)
        for (int x = 0; x < oversampling; ++x) sum += texelFetch(colour_samples, first + ivec2(x, y), 0).rgb;
    imageStore(colours, pixel, vec4(sum / float(oversampling * oversampling), 1));
    imageStore(ids, pixel, uvec4(texelFetch(id_samples, first + oversampling / 2, 0).rg, 0, 0));
}
