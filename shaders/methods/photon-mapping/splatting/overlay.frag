// Photons, or their paths, over a grey picture of the scene, coloured by bounce.  [Smal19 fig. 8.1a]
uniform usampler2D marks;  // low four bits: which colour, from 1; 0: none
uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_normal;

#include "lib/luminance.glsl"

uniform vec3 view_axis_ws;
uniform vec4 mark_colours[8];

layout(location = 0) out vec4 out_colour;

float grey(ivec2 pixel) {
    float light = luminance(texelFetch(gbuffer_albedo, pixel, 0).rgb);
    float facing = abs(dot(texelFetch(gbuffer_normal, pixel, 0).xyz, view_axis_ws));
    return 0.12 * light * (0.3 + 0.7 * facing);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uint mark = texelFetch(marks, pixel, 0).r & 15u;
    out_colour = vec4(mark > 0u ? mark_colours[(mark - 1u) % 8u].rgb : vec3(grey(pixel)), 1);
}
