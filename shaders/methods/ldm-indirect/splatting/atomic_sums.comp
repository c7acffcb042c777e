// Sums of atomic additions as a picture.
layout(local_size_x = 16, local_size_y = 16) in;
uniform usampler2DArray sums;
layout(rgba32f) uniform writeonly image2D irradiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(irradiance)))) return;
    vec4 sum;
    for (int c = 0; c < 4; ++c) sum[c] = uintBitsToFloat(texelFetch(sums, ivec3(pixel, c), 0).x);
    imageStore(irradiance, pixel, sum);
}
