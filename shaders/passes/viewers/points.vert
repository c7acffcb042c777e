// A round point for each element of a point set.
#include "passes/viewers/layer.glsl"
#include "passes/viewers/colour.glsl"
#include "passes/viewers/project.glsl"

uniform float point_px;

layout(location = 0) flat out vec3 colour;
layout(location = 1) flat out uint element;

void main() {
    element = uint(gl_VertexID) * layer.step;
    uint base = element_base(element);
    vec3 position_ws = vector_at(base, layer.place_0);
    colour = vec3(0);
    gl_PointSize = point_px;
    gl_Position = outside;
    if (!is_finite(position_ws) || !passes_filters(base)) return;
    colour = element_colour(base, position_ws);
    gl_Position = clip_position(position_ws);
}
