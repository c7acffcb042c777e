// Light that comes through glass.
layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D glass;
layout(rgba32f) uniform image2D radiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(radiance)))) return;
    vec4 through = texelFetch(glass, pixel, 0);
    if (through.a == 0.0) return;
    vec4 light = imageLoad(radiance, pixel);
    imageStore(radiance, pixel, vec4(light.rgb * through.rgb, light.a));
}
