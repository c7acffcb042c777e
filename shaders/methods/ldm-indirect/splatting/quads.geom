// A rectangle around what is seen of the photon's ellipsoid, straight in the picture: no plane cuts it.
// DEVIATION [Aalund15 §4.2]: not around the ellipse alone, which leaves out pixels of surfaces that bend away
// from its plane, although eq. 5 counts them, and which vanishes seen from its edge.
#include "methods/ldm-indirect/splatting/kernel.glsl"
#include "methods/ldm-indirect/splatting/outline.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) flat in vec4 centre[];
layout(location = 1) flat in vec4 p_axis[];
layout(location = 2) flat in vec3 q_axis[];
layout(location = 3) flat in vec3 normal[];
layout(location = 4) flat in vec3 irradiance[];
layout(location = 5) flat in vec3 to_source[];
layout(location = 6) flat in vec2 beam_of[];

layout(location = 0) flat out vec3 centre_ws;
layout(location = 1) flat out vec3 row_p;
layout(location = 2) flat out vec3 row_q;
layout(location = 3) flat out vec3 row_n;
layout(location = 4) flat out vec3 peak;
layout(location = 5) flat out vec4 to_source_ws;  // w: per_cosine
layout(location = 6) flat out vec2 beam;

void emit(vec2 position_px, Kernel k) {
    vec2 ndc = position_px / size_px * 2.0 - 1.0;
    gl_Position = vec4(ndc.x, -ndc.y, 0.5, 1);
    centre_ws = k.centre_ws;
    row_p = k.row_p;
    row_q = k.row_q;
    row_n = k.row_n;
    peak = k.peak;
    to_source_ws = vec4(k.to_source_ws, k.per_cosine);
    beam = vec2(k.distance, float(k.map));
    EmitVertex();
}

void main() {
    if (centre[0].w == 0.0) return;
    Footprint f = Footprint(true, 0u, centre[0].xyz, normal[0], p_axis[0].xyz, q_axis[0], p_axis[0].w, irradiance[0],
                            to_source[0], beam_of[0].x, uint(beam_of[0].y));
    Outline o = outline_of(f);
    if (!is_in_view(o)) return;
    Kernel k = kernel_of(f);
    emit(o.centre - o.axis_1 - o.axis_2, k);
    emit(o.centre + o.axis_1 - o.axis_2, k);
    emit(o.centre - o.axis_1 + o.axis_2, k);
    emit(o.centre + o.axis_1 + o.axis_2, k);
    EndPrimitive();
}
