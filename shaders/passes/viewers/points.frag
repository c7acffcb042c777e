// Draws the points that won their samples: discs with a darker rim, so that they are told from each other
// and from what is behind.
#include "passes/viewers/layer.glsl"
#include "passes/viewers/colour.glsl"
#include "passes/viewers/project.glsl"
#include "passes/viewers/points.glsl"

uniform float pixel_samples;  // along a side of a pixel

layout(location = 0) out vec4 out_colour;
layout(location = 1) out uvec2 out_id;

void main() {
    ivec2 sample_px = ivec2(gl_FragCoord.xy);
    uint at = uint(sample_px.y) * uint(size_px.x) + uint(sample_px.x), element = nearest_elements[at];
    if (element == 0u) discard;
    --element;
    uint base = element_base(element);
    vec3 position_ws = vector_at(base, layer.place[0]);
    vec2 centre_px;
    float depth;
    point_place(position_ws, centre_px, depth);
    // small points have no room for a rim, and would only be dark
    float rim = smoothstep(0.55, 0.95, distance(gl_FragCoord.xy, centre_px) / point_radius()) *
                smoothstep(2.5, 7.0, point_px / pixel_samples);
    out_colour = vec4(element_colour(base, position_ws) * mix(1.0, 0.35, rim), 1);
    out_id = uvec2(layer.number, element);
    gl_FragDepth = uintBitsToFloat(~nearest_keys[at]);
}
