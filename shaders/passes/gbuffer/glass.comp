// From the sums of logarithms to transmittance, and counts the pixels with glass.
layout(local_size_x = 16, local_size_y = 16) in;

layout(rgba32f) uniform image2D glass;
layout(std430) buffer Pixels { uint pixels; };

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(glass)))) return;
    vec4 sum = imageLoad(glass, pixel);
    if (sum.a > 0.0) atomicAdd(pixels, 1u);
    // more than 1 only where a volume was left that was not entered
    imageStore(glass, pixel, vec4(exp(min(sum.rgb, 0.0)), sum.a));
}
