// Points on rectangles and disks as they are seen: passes::FlatLight (renderers/passes/lights/flat_light.h).
#include "lib/constants.glsl"
#include "passes/lights/sources.glsl"

/// Uniform on the unit disk; squares become sectors of rings.  [Shirley97 §2]
vec2 concentric_disk(vec2 u) {
    vec2 p = 2.0 * u - 1.0;
    if (p == vec2(0)) return p;
    bool wide = abs(p.x) > abs(p.y);
    float radius = wide ? p.x : p.y;
    float angle = PI / 4.0 * (wide ? p.y / p.x : 2.0 - p.x / p.y);
    return radius * vec2(cos(angle), sin(angle));
}

/// To a unit in the last place or two, which built-in functions may miss by far.  [Cephes, asinf]
float precise_asin(float x) {
    float size = abs(x);
    bool is_large = size > 0.5;
    float z = is_large ? 0.5 * (1.0 - min(size, 1.0)) : size * size;
    float root = is_large ? sqrt(z) : size;
    float p = ((((4.2163199048e-2 * z + 2.4181311049e-2) * z + 4.5470025998e-2) * z + 7.4953002686e-2) * z +
               1.6666752422e-1) * z * root + root;
    float angle = is_large ? PI / 2.0 - 2.0 * p : p;
    return x < 0.0 ? -angle : angle;
}

/// A rectangle projected onto the unit sphere around a point, `height` above its plane.  [Urena13 §3]
struct SphericalRectangle {
    vec2 corner, opposite;  // as seen from the point
    float height;
    float b0, b2, shift, solid_angle;
};

/// In single precision: angles are counted from right ones, so that little is lost where they add up to little.
SphericalRectangle spherical_rectangle(vec2 corner, vec2 opposite, float height) {
    SphericalRectangle r;
    r.corner = corner;
    r.opposite = opposite;
    r.height = height;
    // Normals of the four planes through the point and an edge: only their z components count.
    r.b0 = -corner.y / length(vec2(height, corner.y));
    float b1 = opposite.x / length(vec2(height, opposite.x)), b3 = -corner.x / length(vec2(height, corner.x));
    r.b2 = opposite.y / length(vec2(height, opposite.y));
    float g2 = precise_asin(r.b2 * b3), g3 = precise_asin(b3 * r.b0);
    r.shift = g2 + g3;
    r.solid_angle = max(precise_asin(r.b0 * b1) + precise_asin(b1 * r.b2) + r.shift, 0.0);
    return r;
}

/// The point in the plane, by u in [0, 1)².
vec2 sample_rectangle(SphericalRectangle r, vec2 u) {
    // The part of the rectangle to the left of x has the solid angle u.x * solid_angle.  [Urena13 fig. 4]
    float angle = u.x * r.solid_angle - r.shift, sine = sin(angle);
    float f = (cos(angle) * r.b0 + r.b2) / (abs(sine) < 1e-20 ? 1e-20 : sine);
    float cu = clamp((f < 0.0 ? -1.0 : 1.0) / sqrt(f * f + r.b0 * r.b0), -1.0, 1.0);
    float x = clamp(cu * r.height / sqrt(max(1.0 - cu * cu, 1e-30)), r.corner.x, r.opposite.x);
    // Uniform in the sine of the elevation along that line.
    float d = length(vec2(x, r.height));
    float h0 = r.corner.y / length(vec2(d, r.corner.y)), h1 = r.opposite.y / length(vec2(d, r.opposite.y));
    float h = h0 + u.y * (h1 - h0);
    return vec2(x, clamp(h * d / sqrt(max(1.0 - h * h, 1e-30)), r.corner.y, r.opposite.y));
}

/// A lamp as it is seen: sampled by solid angle where that is not 0, else by area.
struct SeenLamp {
    vec2 foot;     // of the point on the lamp's plane
    float height;  // of the point above it; lamps are black from below
    bool by_solid_angle;
    SphericalRectangle rectangle;
};

SeenLamp seen_lamp(LampData lamp, vec3 position_ws) {
    // Farther away than this many half-diagonals the density per solid angle varies by little with the point.
    const float near = 6.0;
    /// DEVIATION from the host, which has double precision: what looks smaller is sampled by area, steradians.
    const float min_solid_angle = 1e-3;
    vec3 offset = position_ws - lamp.centre_ws;
    vec2 half_size = vec2(lamp.half_width, lamp.half_height);
    SeenLamp seen;
    seen.height = dot(offset, lamp.normal_ws);
    seen.foot = vec2(dot(offset, lamp.width_ws), dot(offset, lamp.height_ws));
    seen.by_solid_angle = false;
    if (lamp.is_disk != 0u || !(seen.height > 0.0) ||
        !(dot(offset, offset) < near * near * dot(half_size, half_size)))
        return seen;
    seen.rectangle = spherical_rectangle(-half_size - seen.foot, half_size - seen.foot, seen.height);
    seen.by_solid_angle = seen.rectangle.solid_angle >= min_solid_angle;
    return seen;
}

/// Density per solid angle of the point at this distance.
float pdf_of_lamp(LampData lamp, SeenLamp seen, float distance) {
    if (seen.by_solid_angle) return 1.0 / seen.rectangle.solid_angle;
    return distance * distance * distance / (seen.height * lamp.area);
}

LightSample sample_lamp(LampData lamp, vec3 position_ws, vec2 u) {
    SeenLamp seen = seen_lamp(lamp, position_ws);
    if (!(seen.height > 0.0) || !(lamp.area > 0.0)) return NO_LIGHT_SAMPLE;
    vec2 half_size = vec2(lamp.half_width, lamp.half_height);
    vec2 p = seen.by_solid_angle ? sample_rectangle(seen.rectangle, u)
                                 : half_size * (lamp.is_disk != 0u ? concentric_disk(u) : 2.0 * u - 1.0) - seen.foot;
    vec3 offset = p.x * lamp.width_ws + p.y * lamp.height_ws - seen.height * lamp.normal_ws;
    float distance = length(offset);
    return LightSample(offset / distance, distance, lamp.radiance, pdf_of_lamp(lamp, seen, distance));
}

const float NOT_MET = uintBitsToFloat(0x7f800000u);

/// Distance along the unit direction to the side that sends light; infinite where it is not met.
float lamp_distance(LampData lamp, vec3 origin_ws, vec3 direction_ws) {
    vec3 offset = origin_ws - lamp.centre_ws;
    float height = dot(offset, lamp.normal_ws), fall = -dot(direction_ws, lamp.normal_ws);
    if (!(height > 0.0) || !(fall > 0.0)) return NOT_MET;
    float distance = height / fall;
    vec3 at = offset + distance * direction_ws;
    vec2 p = vec2(dot(at, lamp.width_ws) / lamp.half_width, dot(at, lamp.height_ws) / lamp.half_height);
    bool inside = lamp.is_disk != 0u ? dot(p, p) <= 1.0 : abs(p.x) <= 1.0 && abs(p.y) <= 1.0;
    return inside ? distance : NOT_MET;
}
