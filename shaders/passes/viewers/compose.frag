// The colour of all translucent fragments of a sample, and how much they hide of what is behind. [McGuire13 eq. 2]

uniform sampler2D weighted;
uniform sampler2D optical_depth;

layout(location = 0) out vec4 out_colour;

void main() {
    ivec2 sample_px = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(weighted, sample_px, 0);
    if (sum.a == 0.0) discard;
    out_colour = vec4(sum.rgb / sum.a, 1.0 - exp(-texelFetch(optical_depth, sample_px, 0).r));
}
