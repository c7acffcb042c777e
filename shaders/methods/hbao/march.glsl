// Horizons of the depth image about a point, and what lies open between them. [Bavoil08]
//
// The zenith v points from the pixel's point x to the viewer. A slice is the half plane of v and a direction d at
// right angles to it; in it, θ is the angle from v. All that a ray of the picture along d's projection sees lies
// in that half plane, for perspective and orthographic views alike, so the depth image gives the slice's horizon:
// the least θ at which something is seen. Between v and the horizon the slice is open.
//
// DEVIATION [Bavoil08]: there the zenith is the view's axis and positions are taken to advance along it, which is
// only right in the middle of a perspective picture. With the axis through the pixel slices are exact everywhere.
#include "lib/constants.glsl"
#include "lib/pattern_shift.glsl"
#include "lib/pixel_rays.glsl"
#include "lib/random.glsl"

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;

uniform mat4 pixel_from_world;  // homogeneous; pixels from the upper left corner


struct Point {
    bool exists;
    ivec2 pixel;
    vec3 position, normal, geometric_normal;
    vec3 zenith;            // v
    vec3 across, down;      // at right angles to it, the first along the picture's rows
    float view_distance;    // metres; infinite for orthographic views
    vec2 shift;             // of directions and of steps, as parts of one
};

struct Slice {
    vec3 direction;      // d
    float tangent;       // θ at which the triangle's plane ends the slice
    float first, last;   // θ between which the shading normal's cosine is above 0
    vec2 normal;         // its cosines with v and d
    vec2 start_px, direction_px;
    float length_px;     // of the march
    int steps;
    bool cut;            // by the picture's edge
};

vec2 shift_of(ivec2 pixel) {
    if (params.turning == TURNING_NONE) return vec2(0.0, 1.0);
    if (params.turning == TURNING_PATTERN) return pattern_shift(pixel).xy;
    return unit_float(pcg2d(uvec2(pixel)));
}

Point point_at(ivec2 pixel) {
    Point x;
    x.pixel = pixel;
    x.geometric_normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    x.exists = x.geometric_normal != vec3(0.0);
    if (!x.exists) return x;
    x.position = texelFetch(gbuffer_position, pixel, 0).xyz;
    x.normal = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
    // Half floats: what differs by their rounding is the same, so that an open plane is exactly 1.
    if (dot(x.normal, x.geometric_normal) > 1.0 - 1e-6) x.normal = x.geometric_normal;
    vec2 middle = vec2(pixel) + 0.5;
    x.zenith = -normalize(pixel_ray_direction(middle));
    vec3 row = ray_origin_dx + ray_direction_dx;
    x.across = normalize(row - dot(row, x.zenith) * x.zenith);
    x.down = cross(x.zenith, x.across);
    x.view_distance = is_perspective() ? distance(x.position, ray_origin_ws) : 1.0 / 0.0;
    x.shift = shift_of(pixel);
    return x;
}

/// ∫ cosine⁺ sinθ dθ from 0 to θ: twice the part of the slice's weight there. With the cosine
/// a cosθ + b sinθ (a, b the normal's cosines with v and d), positive from θ₀ to θ₁, the integral from 0 is
///     F(θ) = a sin²θ / 2 + b (θ − sinθ cosθ) / 2,
/// and the weight F(min(θ, θ₁)) − F(θ₀). Over all slices, F(tangent) adds up to π / (2π / N).
/// Published: ∫ sinθ dθ = 1 − cosθ, that is sin h − sin t of elevations h = π/2 − θ. It weighs by solid angle.
float primitive(vec2 normal, float angle) {
    float s = sin(angle), c = cos(angle);
    return 0.5 * (normal.x * s * s + normal.y * (angle - s * c));
}

float weight_up_to(Slice slice, float angle) {
    if (params.weighting == WEIGHTING_PUBLISHED) return 1.0 - cos(angle);
    float a = clamp(angle, slice.first, slice.last);
    return slice.last > slice.first ? primitive(slice.normal, a) - primitive(slice.normal, slice.first) : 0.0;
}

/// θ at which the slice starts to be open: the triangle's plane, or with the published weighting higher by the
/// bias, so that nothing between counts.
float first_horizon(Slice slice) {
    return params.weighting == WEIGHTING_PUBLISHED ? max(slice.tangent - radians(params.angle_bias), 0.0)
                                                   : slice.tangent;
}

/// All of a slice's weight, closed or not.
float whole_weight(Slice slice) {
    return params.weighting == WEIGHTING_PUBLISHED ? weight_up_to(slice, first_horizon(slice))
                                                   : weight_up_to(slice, PI);
}

/// Pixels to where the ball of the radius about x ends in the picture, along a slice; infinite where it reaches
/// to the viewer or beyond.
/// DEVIATION [Bavoil08]: there the radius is projected as it lies at x's depth, which misses what is as far away
/// but nearer to the viewer.
float reach_px(Point x, vec3 direction, vec2 start_px, vec4 step) {
    const float unlimited = 1.0 / 0.0;
    float radius = params.max_distance;
    if (radius == 0.0) return unlimited;
    if (isinf(x.view_distance)) return length(step.xy) * radius;
    float s = radius / x.view_distance;
    if (s >= 1.0) return unlimited;
    vec4 edge = pixel_from_world * vec4(s * direction - sqrt(1.0 - s * s) * x.zenith, 0.0);
    return edge.w <= 0.0 ? unlimited : distance(edge.xy / edge.w, start_px);
}

/// Pixels along `direction` until the last pixel's middle.
float picture_px(vec2 start, vec2 direction) {
    vec2 last = vec2(textureSize(gbuffer_position, 0)) - 0.5;
    float most = 1.0 / 0.0;
    for (int i = 0; i < 2; ++i)
        if (direction[i] != 0.0)
            most = min(most, ((direction[i] > 0.0 ? last[i] : 0.5) - start[i]) / direction[i]);
    return most;
}

void aim(inout Slice slice, Point x) {
    slice.start_px = vec2(x.pixel) + 0.5;
    vec4 here = pixel_from_world * vec4(x.position, 1.0);
    vec4 step = pixel_from_world * vec4(slice.direction, 0.0);
    step.xy = (step.xy - slice.start_px * step.w) / here.w;  // how the projection moves
    slice.direction_px = normalize(step.xy);
    float reach = max(reach_px(x, slice.direction, slice.start_px, step), 1.0);
    float picture = picture_px(slice.start_px, slice.direction_px);
    slice.cut = reach > picture;
    slice.length_px = min(reach, picture);
    slice.steps = int(min(float(params.steps), ceil(slice.length_px)));
}

Slice slice_of(Point x, int index) {
    Slice slice;
    float azimuth = 2.0 * PI * (float(index) + x.shift.x) / float(params.directions);
    slice.direction = cos(azimuth) * x.across + sin(azimuth) * x.down;
    slice.normal = vec2(dot(x.normal, x.zenith), dot(x.normal, slice.direction));
    float middle = atan(slice.normal.y, slice.normal.x);
    slice.first = clamp(middle - 0.5 * PI, 0.0, PI);
    slice.last = clamp(middle + 0.5 * PI, 0.0, PI);
    slice.tangent = clamp(atan(dot(x.geometric_normal, slice.direction),
                               max(dot(x.geometric_normal, x.zenith), 0.0)) + 0.5 * PI, 0.0, PI);
    aim(slice, x);
    return slice;
}

struct Sample {
    ivec2 pixel;
    bool counts;      // a surface within the radius and above the bias
    vec3 position;
    float distance;   // metres
    float angle;      // θ
};

Sample sample_of(Point x, Slice slice, int step) {
    float t = (float(step) + x.shift.y) / float(slice.steps) * slice.length_px;
    Sample s;
    s.pixel = ivec2(floor(slice.start_px + max(t, 1.0) * slice.direction_px));
    s.pixel = clamp(s.pixel, ivec2(0), textureSize(gbuffer_position, 0) - 1);
    vec4 position = texelFetch(gbuffer_position, s.pixel, 0);
    s.position = position.xyz;
    vec3 way = s.position - x.position;
    s.distance = length(way);
    s.angle = acos(clamp(dot(way, x.zenith) / max(s.distance, 1e-30), -1.0, 1.0));
    float rounding = 2e-6 * (length(x.position) + s.distance);
    s.counts = position.w > 0.0 && s.pixel != x.pixel &&
               (params.max_distance == 0.0 || s.distance < params.max_distance) &&
               dot(way, x.geometric_normal) > sin(radians(params.angle_bias)) * s.distance + rounding;
    return s;
}

/// What a hit at this distance takes away, 1 − V: all of it, or with the smooth fall-off V = (d/d_max)² the
/// published attenuation 1 − d²/d_max².
float occlusion(float distance_ws) {
    if (params.max_distance == 0.0 || params.falloff == FALLOFF_HARD) return 1.0;
    float part = distance_ws / params.max_distance;
    return 1.0 - part * part;
}
