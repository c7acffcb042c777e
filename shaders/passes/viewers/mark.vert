// The outline of one element, as a closed band of segments: six vertices for each.
#include "lib/spaces.glsl"
#include "passes/viewers/layer.glsl"
#include "passes/viewers/colour.glsl"
#include "passes/viewers/project.glsl"

layout(location = 0) flat out vec3 colour;

uniform vec3 mark_colour;
uniform bool own_colour;  // the element's own instead
uniform uint marked;      // element
uniform float band_px;    // width of the outline
uniform float ring_px;    // radius around points
uniform int segments;

// A corner of the outline; k counts around. False where there is none.
bool unit_sphere_silhouette(mat3 axes, vec3 centre_ws, float angle, out vec3 place_ws) {
    mat3 inverse_axes = inverse(axes);
    vec3 to_eye = inverse_axes * (orthographic ? -view_axis_ws : eye_ws - centre_ws);
    float far = length(to_eye);
    place_ws = centre_ws;
    if (!(far > 0.0) || (!orthographic && far <= 1.0)) return false;
    vec3 n = to_eye / far;
    // the points at which rays touch the sphere lie on a circle around n, 1 / far from the middle
    float height = orthographic ? 0.0 : 1.0 / far, radius = sqrt(1.0 - height * height);
    mat3 frame = frame_around(n);
    place_ws += axes * (height * n + radius * (cos(angle) * frame[0] + sin(angle) * frame[1]));
    return is_finite(place_ws);
}

bool outline_place(uint base, int k, out vec3 place_ws) {
    vec3 first = vector_at(base, layer.place[0]);
    place_ws = first;
    if (layer.primitive == PRIMITIVE_LINES) {
        place_ws = k == 0 ? first : vector_at(base, layer.place[1]);
        return is_finite(place_ws);
    }
    if (layer.primitive == PRIMITIVE_POINTS) return is_finite(first);
    vec3 second = vector_at(base, layer.place[1]);
    float angle = 6.28318530717959 * float(k) / float(segments);
    if (layer.primitive == PRIMITIVE_DISCS) {
        if (length(second) == 0.0) return false;
        mat3 frame = frame_around(normalize(second));
        place_ws += float_at(base, layer.place[2]) * (cos(angle) * frame[0] + sin(angle) * frame[1]);
    } else if (layer.primitive == PRIMITIVE_PARALLELOGRAMS) {
        int corner = k & 3;
        place_ws += (corner == 0 || corner == 3 ? -1.0 : 1.0) * second +
                    (corner < 2 ? -1.0 : 1.0) * vector_at(base, layer.place[2]);
    } else {
        return unit_sphere_silhouette(mat3(second, vector_at(base, layer.place[2]), vector_at(base, layer.place[3])),
                                      first, angle, place_ws);
    }
    return is_finite(place_ws);
}

// A corner of the ring around a point, on the picture.
vec4 on_ring(vec4 centre, int k) {
    float angle = 6.28318530717959 * float(k) / float(segments);
    return vec4(centre.xy + ring_px * vec2(cos(angle), sin(angle)) / (0.5 * size_px) * centre.w, centre.zw);
}

void main() {
    uint base = element_base(marked);
    int k = gl_VertexID / 6;
    vec3 from_ws, to_ws;
    gl_Position = outside;
    colour = mark_colour;
    if (!outline_place(base, k, from_ws) || !outline_place(base, k + 1, to_ws)) return;
    vec4 a = clip_position(from_ws), b = clip_position(to_ws);
    if (!clip_segment(a, b)) return;
    if (layer.primitive == PRIMITIVE_POINTS) {
        a = on_ring(a, k);
        b = on_ring(b, k + 1);
    }
    gl_Position = band_corner(a, b, quad_corner(gl_VertexID % 6), band_px, 0.3 * band_px);
    if (own_colour) colour = element_colour(base, 0.5 * (from_ws + to_ws));
    gl_Position.z = 0.0;  // on top of everything
}
