// Discs, parallelograms, and points of a translucent layer as discs that face the viewer: six vertices for
// each element.
#include "lib/spaces.glsl"
#include "passes/viewers/layer.glsl"
#include "passes/viewers/colour.glsl"
#include "passes/viewers/project.glsl"

uniform float point_px;  // diameter of points, in samples of the picture

layout(location = 0) flat out vec3 colour;
layout(location = 1) flat out uint element;
layout(location = 2) flat out vec3 normal_ws;
layout(location = 3) out vec2 place;  // -1…1 along both half-sides
layout(location = 4) out vec3 position_ws;

// The half-sides; false where a number is missing.
bool half_sides(uint base, out vec3 u, out vec3 v) {
    if (layer.primitive == PRIMITIVE_PARALLELOGRAMS) {
        u = vector_at(base, layer.place[1]);
        v = vector_at(base, layer.place[2]);
        return is_finite(u) && is_finite(v);
    }
    vec3 n = vector_at(base, layer.place[1]);
    float radius = float_at(base, layer.place[2]), size = length(n);
    u = v = vec3(0);
    if (!is_finite(n) || !is_finite(radius) || size == 0.0) return false;
    mat3 frame = frame_around(n / size);
    u = radius * frame[0];
    v = radius * frame[1];
    return true;
}

void main() {
    element = uint(gl_VertexID / 6) * layer.step;
    uint base = element_base(element);
    vec3 centre_ws = vector_at(base, layer.place[0]), u, v;
    colour = normal_ws = position_ws = vec3(0);
    place = vec2(0);
    gl_Position = outside;
    if (!is_finite(centre_ws) || !passes_filters(base)) return;
    if (layer.primitive == PRIMITIVE_POINTS) {
        vec4 clip = clip_position(centre_ws);
        if (clip.w < min_w) return;
        colour = element_colour(base, centre_ws);
        place = quad_corner(gl_VertexID % 6);
        position_ws = centre_ws;
        normal_ws = normalize(towards_viewer(centre_ws));
        gl_Position = clip + vec4(point_px * place / size_px * clip.w, 0, 0);
        return;
    }
    if (!half_sides(base, u, v)) return;
    vec3 across = cross(u, v);
    float area = length(across);
    if (area == 0.0) return;
    normal_ws = across / area;
    colour = element_colour(base, centre_ws);
    place = quad_corner(gl_VertexID % 6);
    position_ws = centre_ws + place.x * u + place.y * v;
    gl_Position = clip_position(position_ws);
}
