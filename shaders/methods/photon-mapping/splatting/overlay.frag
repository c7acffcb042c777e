// Photons over a grey picture of the scene, coloured by bounce.  [Smal19 fig. 8.1a]
uniform usampler2D dots;
uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_normal;

#include "lib/luminance.glsl"

uniform vec3 view_axis_ws;

layout(location = 0) out vec4 out_colour;

/// Red, green and blue for the first three bounces, as published; then yellow, magenta, cyan, orange, white.
const vec3 bounce_colours[8] = vec3[8](vec3(1, 0.05, 0.05), vec3(0.05, 1, 0.05), vec3(0.1, 0.2, 1), vec3(1, 0.9, 0.05),
                                       vec3(1, 0.1, 1), vec3(0.05, 1, 1), vec3(1, 0.4, 0.02), vec3(1));

float grey(ivec2 pixel) {
    float light = luminance(texelFetch(gbuffer_albedo, pixel, 0).rgb);
    float facing = abs(dot(texelFetch(gbuffer_normal, pixel, 0).xyz, view_axis_ws));
    return 0.12 * light * (0.3 + 0.7 * facing);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uint bounce = texelFetch(dots, pixel, 0).r & 15u;
    out_colour = vec4(bounce > 0u ? bounce_colours[(bounce - 1u) % 8u] : vec3(grey(pixel)), 1);
}
