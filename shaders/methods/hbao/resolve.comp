// From sums over directions to accessibility: divided by all weight, so that an open plane has exactly 1.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D sums;
layout(r32f) uniform writeonly image2D raw;
layout(r32f) uniform writeonly image2D cut;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(raw)))) return;
    vec4 sum = texelFetch(sums, pixel, 0);
    imageStore(raw, pixel, vec4(sum.y > 0.0 ? sum.x / sum.y : 1.0));
    imageStore(cut, pixel, vec4(sum.z / float(params.directions)));
}
