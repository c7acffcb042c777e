// Depths of the surfaces that a texel stands for.
//
// DEVIATION [Smal19 §6.2.1]: of low resolution a texel is for one of its pixels, and is rasterised at that pixel's
// middle. The thesis tests closest and farthest of its pixels, and kernels have to hold both: at edges few do. In the
// Cornell box half resolution then has 0.95 of the light of full resolution, and quarter 0.87.
#include "methods/photon-mapping/splatting/splat_view.glsl"

uniform sampler2D gbuffer_position;

layout(location = 0) out float out_depth;

const float nothing = uintBitsToFloat(0x7f800000u);  // infinite

void main() {
    ivec2 pixel = divisor * ivec2(gl_FragCoord.xy) + pixel_of_texel;
    vec4 position = vec4(0);
    if (all(lessThan(pixel, textureSize(gbuffer_position, 0)))) position = texelFetch(gbuffer_position, pixel, 0);
    out_depth = position.w > 0.0 ? view_depth(position.xyz) : nothing;
    // 1 is in front of everything: no kernel is drawn on the background
    gl_FragDepth = position.w > 0.0 ? clamp(reversed_depth(out_depth), 0.0, 1.0) : 1.0;
}
