// A quad around each ellipsoid: six vertices for each element. The quad's edges are the tangent planes of
// the ellipsoid that are vertical and horizontal on the picture. [Sigg06]
#include "passes/viewers/layer.glsl"
#include "passes/viewers/colour.glsl"
#include "passes/viewers/project.glsl"

layout(location = 0) flat out vec3 colour;
layout(location = 1) flat out uint element;
layout(location = 2) flat out vec3 centre_ws;
// Rows: what takes world vectors to the space in which the ellipsoid is the unit sphere.
layout(location = 3) flat out vec3 row_0;
layout(location = 4) flat out vec3 row_1;
layout(location = 5) flat out vec3 row_2;

const float min_part = 1e-3;  // of the longest half-axis: flatter ellipsoids are drawn so thick

// An axis too short to invert gets a small length across the two others.
void thicken(inout vec3 axis, vec3 a, vec3 b, float longest) {
    if (length(axis) >= min_part * longest) return;
    vec3 across = cross(a, b);
    float size = length(across);
    if (size > 0.0) axis = min_part * longest / size * across;
}

// Least and most of one coordinate on the picture; false where the ellipsoid reaches behind the eye.
bool silhouette(vec4 row, vec4 w_row, out vec2 range) {
    const vec4 quadric = vec4(1, 1, 1, -1);
    float a = dot(quadric * w_row, w_row), b = dot(quadric * row, w_row), c = dot(quadric * row, row);
    range = vec2(-1, 1);
    if (a >= 0.0) return false;
    float root = sqrt(max(0.0, b * b - a * c));
    range = vec2((b + root) / a, (b - root) / a);
    return true;
}

void main() {
    element = uint(gl_VertexID / 6) * layer.step;
    uint base = element_base(element);
    centre_ws = vector_at(base, layer.place[0]);
    vec3 u = vector_at(base, layer.place[1]), v = vector_at(base, layer.place[2]),
         w = vector_at(base, layer.place[3]);
    colour = row_0 = row_1 = row_2 = vec3(0);
    gl_Position = outside;
    if (!is_finite(centre_ws) || !is_finite(u) || !is_finite(v) || !is_finite(w) || !passes_filters(base)) return;
    float longest = max(length(u), max(length(v), length(w)));
    thicken(w, u, v, longest);
    thicken(v, w, u, longest);
    thicken(u, v, w, longest);
    // columns scaled to about 1, so that tiny ellipsoids do not underflow
    if (longest == 0.0 || abs(determinant(mat3(u, v, w) / longest)) < 1e-12) return;
    mat3 inverse_axes = inverse(mat3(u, v, w) / longest) / longest;
    row_0 = vec3(inverse_axes[0].x, inverse_axes[1].x, inverse_axes[2].x);
    row_1 = vec3(inverse_axes[0].y, inverse_axes[1].y, inverse_axes[2].y);
    row_2 = vec3(inverse_axes[0].z, inverse_axes[1].z, inverse_axes[2].z);

    mat4 clip_from_sphere = clip_from_world * mat4(vec4(u, 0), vec4(v, 0), vec4(w, 0), vec4(centre_ws, 1));
    mat4 rows = transpose(clip_from_sphere);
    vec4 centre = clip_from_sphere[3];
    vec2 range_x, range_y;
    bool in_front = silhouette(rows[0], rows[3], range_x) && silhouette(rows[1], rows[3], range_y);
    if (in_front && centre.w <= 0.0) return;
    if (!in_front) range_x = range_y = vec2(-1, 1);
    colour = element_colour(base, centre_ws);
    vec2 corner = 0.5 + 0.5 * quad_corner(gl_VertexID % 6);
    gl_Position = vec4(mix(range_x.x, range_x.y, corner.x), mix(range_y.x, range_y.y, corner.y), 0.5, 1);
}
