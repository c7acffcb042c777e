// A band for each element of a line set: six vertices each.
#include "passes/viewers/layer.glsl"
#include "passes/viewers/colour.glsl"
#include "passes/viewers/project.glsl"

uniform float line_px;

layout(location = 0) flat out vec3 colour;
layout(location = 1) flat out uint element;
layout(location = 2) noperspective out float across;  // -1…1

void main() {
    element = uint(gl_VertexID / 6) * layer.step;
    uint base = element_base(element);
    vec3 start_ws = vector_at(base, layer.place[0]), end_ws = vector_at(base, layer.place[1]);
    colour = vec3(0);
    across = 0.0;
    gl_Position = outside;
    if (!is_finite(start_ws) || !is_finite(end_ws) || !passes_filters(base)) return;
    vec4 a = clip_position(start_ws), b = clip_position(end_ws);
    if (!clip_segment(a, b)) return;
    colour = element_colour(base, 0.5 * (start_ws + end_ws));
    vec2 corner = quad_corner(gl_VertexID % 6);
    across = corner.y;
    gl_Position = band_corner(a, b, corner, line_px, 0.5 * line_px / layer.size_px);
}
