// Where in the picture a footprint's ellipsoid is seen.
#include "methods/ldm-indirect/splatting/footprint.glsl"
#include "methods/ldm-indirect/view.glsl"

uniform vec2 size_px;

/// A rectangle around the outline, in pixels from the upper left corner. No axes: it is not in view.
struct Outline {
    vec2 centre, axis_1, axis_2;
    vec2 half_size;  // of the upright rectangle around it
};

/// Keeps pixels whose middle is on the outline, as rounded.
const float margin_px = 0.02;

/// Place or direction in pixels times w, and w.
vec3 homogeneous_px(vec4 v_ws) {
    vec4 clip = clip_from_world * v_ws;
    return vec3(0.5 * (clip.w + clip.x) * size_px.x, 0.5 * (clip.w - clip.y) * size_px.y, clip.w);
}

/// Rectangle around the part of the box around the ellipsoid that is before the eye.
Outline clipped_box(vec3 c, vec3 p, vec3 q, vec3 h) {
    float nearest = 0.5 * near_plane;
    vec2 low = vec2(1e30), high = vec2(-1e30);
    for (int corner = 0; corner < 8; ++corner) {
        vec3 signs = vec3(corner & 1, corner >> 1 & 1, corner >> 2) * 2.0 - 1.0;
        vec3 a = c + signs.x * p + signs.y * q + signs.z * h;
        if (a.z >= nearest) {
            low = min(low, a.xy / a.z);
            high = max(high, a.xy / a.z);
        }
        for (int axis = 0; axis < 3; ++axis) {
            vec3 b = a - 2.0 * signs[axis] * (axis == 0 ? p : axis == 1 ? q : h);
            if (a.z < nearest || b.z >= nearest) continue;
            vec3 cut = mix(a, b, (a.z - nearest) / (a.z - b.z));
            low = min(low, cut.xy / cut.z);
            high = max(high, cut.xy / cut.z);
        }
    }
    low = max(low, vec2(-1));
    high = min(high, size_px + 1.0);
    vec2 half_size = 0.5 * (high - low);
    if (any(lessThanEqual(half_size, vec2(0)))) return Outline(vec2(0), vec2(0), vec2(0), vec2(-1));
    return Outline(0.5 * (low + high), vec2(half_size.x, 0), vec2(0, half_size.y), half_size);
}

/// The projection of an ellipsoid is an ellipse, whose centre and matrix are those of the dual conic
/// p pᵀ + q qᵀ + h hᵀ - c cᵀ of homogeneous places; those taken from the projected centre keep small ones exact.
Outline outline_of(Footprint f) {
    vec3 c_ws = f.centre_ws, h_ws = f.height * f.n_ws;
    float wider = 1.0;
    if (f.distance > 0.0) {  // the least ellipsoid around the cylinder
        wider = sqrt(1.5);
        c_ws += (1.0 - 0.5 * (BEAM_BEGINS + BEAM_ENDS)) * f.distance * f.to_source_ws;
        h_ws = sqrt(3.0) * 0.5 * (BEAM_ENDS - BEAM_BEGINS) * f.distance * f.to_source_ws;
    }
    vec3 c = homogeneous_px(vec4(c_ws, 1));
    vec3 p = homogeneous_px(vec4(wider * f.p_ws, 0)), q = homogeneous_px(vec4(wider * f.q_ws, 0));
    vec3 h = homogeneous_px(vec4(h_ws, 0));
    vec3 reach = vec3(p.z, q.z, h.z);
    float w = c.z * c.z - dot(reach, reach);
    if (c.z <= 0.0 || w <= 0.02 * c.z * c.z) return clipped_box(c, p, q, h);
    vec2 middle = c.xy / c.z;
    p.xy -= middle * p.z;
    q.xy -= middle * q.z;
    h.xy -= middle * h.z;
    vec3 xs = vec3(p.x, q.x, h.x), ys = vec3(p.y, q.y, h.y);
    vec2 shift = -vec2(dot(xs, reach), dot(ys, reach)) / w;
    float xx = shift.x * shift.x + dot(xs, xs) / w, yy = shift.y * shift.y + dot(ys, ys) / w;
    float xy = shift.x * shift.y + dot(xs, ys) / w;
    float spread = length(vec2(0.5 * (xx - yy), xy)), mean = 0.5 * (xx + yy);
    float angle = xy == 0.0 && xx == yy ? 0.0 : 0.5 * atan(2.0 * xy, xx - yy);
    vec2 along = vec2(cos(angle), sin(angle));
    vec2 centre = middle + shift;
    float longer = 1.001 * sqrt(mean + spread) + margin_px, shorter = 1.001 * sqrt(max(mean - spread, 0.0)) + margin_px;
    return Outline(centre, longer * along, shorter * vec2(-along.y, along.x),
                   min(1.001 * sqrt(vec2(xx, yy)) + margin_px, vec2(longer)));
}

bool is_in_view(Outline o) {
    return o.half_size.x > 0.0 && all(lessThan(o.centre - o.half_size, size_px)) &&
           all(greaterThan(o.centre + o.half_size, vec2(0)));
}

/// First and last pixels whose middles it may hold.
ivec4 pixels_of(Outline o) {
    vec2 last = size_px - 1.0;
    return ivec4(clamp(floor(o.centre - o.half_size - 0.5), vec2(0), last),
                 clamp(ceil(o.centre + o.half_size - 0.5), vec2(0), last));
}
