// Sums of atomic additions as a picture.
layout(local_size_x = 16, local_size_y = 16) in;
uniform usampler2DArray sums;
layout(rgba32f) uniform writeonly image2D irradiance;
layout(rgba32f) uniform writeonly image2D directions;

float sum_at(ivec2 pixel, int layer) { return uintBitsToFloat(texelFetch(sums, ivec3(pixel, layer), 0).x); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(irradiance)))) return;
    vec4 sum, direction = vec4(0);
    for (int c = 0; c < 4; ++c) sum[c] = sum_at(pixel, c);
    for (int c = 0; c < 3; ++c) direction[c] = sum_at(pixel, 4 + c);
    imageStore(irradiance, pixel, sum);
    imageStore(directions, pixel, direction);
}
