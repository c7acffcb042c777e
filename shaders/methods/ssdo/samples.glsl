// Samples about a pixel's point and what became of them. [Ritschel09 §3]
//
// Sample i is a step of random length λ in (0, r] along one of N directions over the hemisphere of the triangle's
// normal, equally dense in solid angle. The point where it ends is looked up in the picture: behind the surface that
// is seen there, that surface is an occluder; else the direction is open. With LAYERS above 1 the surfaces behind it
// are looked up, too: a step that ends behind the back of a body is open.
//
// DEVIATION [Ritschel09 §3.1]: behind is decided by the plane of the pixel's triangle, not by the pixel's depth, which
// lets floors seen at grazing angles occlude themselves by the steps between pixels.
#define LIGHT 1
#include "lib/pattern_shift.glsl"
#include "lib/pixel_rays.glsl"
#include "lib/random.glsl"
#include "passes/bounce/receiver.glsl"

uniform sampler2D environment_texture;  // equirectangular
uniform sampler2D senders_texture;
#if LAYERS > 1
// Behind what is seen, layer 2 first.
uniform sampler2DArray hidden_positions;  // w 0: none
uniform sampler2DArray hidden_normals;    // of the triangles' fronts
uniform sampler2DArray hidden_senders;
#endif

uniform mat4 pixel_from_world;  // homogeneous; pixels from the upper left corner
uniform float reach;            // r, m
uniform uint seed;

// What became of a sample; explain.cpp says it in words.
const uint OUTSIDE = 0u, OPEN = 1u, SENDS = 2u, TURNED_AWAY = 3u, BELOW = 4u, BEYOND = 5u;

struct Point {
    bool exists;
    ivec2 pixel;
    vec3 position, geometric_normal;
    mat3 frame;  // about the geometric normal
    bool is_lit;
    Scatterer scatterer;
    SeenScatterer seen;
    vec3 shift;  // of the directions' heights, azimuths and of the steps, as parts of one
};

struct Sample {
    bool is_outside;   // of the picture
    bool is_occluded;
    vec3 direction;    // of the step
    vec3 end;          // of the step, world space
    ivec2 pixel;       // that shows what is there
    int layers;        // that the end lies behind, one after the other
};

/// A surface along a pixel's view ray; layer 0 is seen.
struct Layer {
    bool exists;
    vec3 position;
    vec3 normal;  // of the side that sends
    vec3 facing;  // the same, turned to the viewer
};

struct Occluder {
    uint role;
    vec3 position;
    vec3 facing;       // its normal, turned to the viewer
    vec3 to_occluder;  // unit
    float distance;    // m, from x to it
    float sending;     // cosine at it
    int layer;
};

vec3 shift_of(ivec2 pixel) {
    if (params.turning == TURNING_NONE) return vec3(0.5);
    if (params.turning == TURNING_PATTERN) return pattern_shift(pixel);
    return unit_float(pcg3d(uvec3(pixel, seed)));
}

Point point_at(ivec2 pixel) {
    Receiver receiver = receiver_at(pixel);
    Point x;
    x.pixel = pixel;
    x.exists = receiver.exists;
    if (!x.exists) return x;
    x.position = receiver.position;
    x.geometric_normal = receiver.geometric_normal;
    x.frame = frame_around(x.geometric_normal);
    x.shift = shift_of(pixel);
    vec4 material = texelFetch(gbuffer_material, pixel, 0);
    x.is_lit = !is_unlit(material);
    x.scatterer = scatterer_of(receiver, texelFetch(gbuffer_albedo, pixel, 0).rgb, material);
    x.seen = seen_from(x.scatterer, viewer_of(receiver));
    return x;
}

/// Least of the lengths that are spread logarithmically, as a part of r.
// C++: ir::methods::ssdo::min_length
const float MIN_LENGTH = 0.0078125;

/// Lengths that the density estimator asks for: half of them uniform, half uniform in their logarithm, so that near
/// senders are not found by rare samples that count very much.
float mixed_length(float u) { return u <= 0.5 ? 2.0 * u : pow(MIN_LENGTH, 2.0 * u - 1.0); }

/// The R2 sequence's steps.
// C++: ir::methods::ssdo::r2_azimuth
const float R2_AZIMUTH = 0.7548776662;
// C++: ir::methods::ssdo::r2_length
const float R2_LENGTH = 0.5698402910;

/// Heights in equal strata, azimuths and lengths by the R2 sequence: a shifted lattice.
vec4 step_of(Point x, int i, bool mixed) {
    float height = 1.0 - (float(i) + x.shift.x) / float(params.samples);
    float azimuth = 2.0 * PI * fract(float(i) * R2_AZIMUTH + x.shift.y);
    float length_part = 1.0 - fract(float(i) * R2_LENGTH + x.shift.z);
    if (mixed) length_part = mixed_length(length_part);
    float radius = sqrt(max(1.0 - height * height, 0.0));
    return vec4(x.frame * vec3(radius * cos(azimuth), radius * sin(azimuth), height), length_part * reach);
}

/// Σ of the directions' cosines with the geometric normal; N/2 up to the shift.
float all_cosines(Point x) { return 0.5 * float(params.samples + 1) - x.shift.x; }

Layer layer_at(ivec2 pixel, int layer) {
#if LAYERS > 1
    if (layer > 0) {
        ivec3 place = ivec3(pixel, layer - 1);
        vec4 position = texelFetch(hidden_positions, place, 0);
        vec3 normal = texelFetch(hidden_normals, place, 0).xyz;
        bool is_entered = dot(normal, pixel_ray_direction(vec2(pixel) + 0.5)) < 0.0;
        return Layer(position.w > 0.0, position.xyz, normal, is_entered ? normal : -normal);
    }
#endif
    vec4 position = texelFetch(gbuffer_position, pixel, 0);
    vec3 normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    return Layer(position.w > 0.0, position.xyz, normal, normal);
}

vec3 light_of_layer(ivec2 pixel, int layer) {
#if LAYERS > 1
    if (layer > 0) return texelFetch(hidden_senders, ivec3(pixel, layer - 1), 0).rgb;
#endif
    return texelFetch(senders_texture, pixel, 0).rgb;
}

/// Which layers lie before the step's end. The last of them occludes unless a body is left there.
///
/// DEVIATION [Ritschel09 §4]: the winding says where a body is left, not whether the number of layers is even, which
/// turns all inside out behind a sheet that is no body. What is seen counts as entered.
void look_behind(inout Sample s, float rounding) {
    for (int layer = 0; layer < LAYERS; ++layer) {
        Layer surface = layer_at(s.pixel, layer);
        if (!surface.exists || dot(s.end - surface.position, surface.facing) >= -rounding) break;
        s.is_occluded = surface.facing == surface.normal;
        s.layers = layer + 1;
    }
}

Sample sample_of(Point x, int i, bool mixed) {
    vec4 way = step_of(x, i, mixed);
    Sample s;
    s.is_outside = true;
    s.is_occluded = false;
    s.direction = way.xyz;
    s.end = x.position + way.w * way.xyz;
    s.pixel = ivec2(-1);
    s.layers = 0;
    vec4 projected = pixel_from_world * vec4(s.end, 1.0);
    if (projected.w <= 0.0) return s;
    vec2 place = projected.xy / projected.w;
    ivec2 size = textureSize(gbuffer_position, 0);
    if (any(lessThan(place, vec2(0.0))) || any(greaterThanEqual(place, vec2(size)))) return s;
    s.pixel = ivec2(place);
    s.is_outside = false;
    look_behind(s, 2e-6 * (length(x.position) + way.w));
    return s;
}

/// What an occluder is to x.
uint role_of_occluder(Point x, Occluder o) {
    if (params.estimator == ESTIMATOR_DENSITY && params.max_distance > 0.0 && o.distance > params.max_distance)
        return BEYOND;
    if (!is_above(x.scatterer, o.to_occluder)) return BELOW;
    return o.sending > 0.0 ? SENDS : TURNED_AWAY;
}

/// One of the layers before the step's end.
Occluder occluder_of(Point x, Sample s, int layer) {
    Layer surface = layer_at(s.pixel, layer);
    Occluder o;
    o.layer = layer;
    o.position = surface.position;
    o.facing = surface.facing;
    o.distance = distance(surface.position, x.position);
    o.to_occluder = (surface.position - x.position) / max(o.distance, 1e-30);
    o.sending = -dot(surface.normal, o.to_occluder);
    o.role = role_of_occluder(x, o);
    return o;
}

/// For the environment's light lengths are uniform, as published.
Sample sky_sample_of(Point x, int i) { return sample_of(x, i, false); }
Sample sender_sample_of(Point x, int i) { return sample_of(x, i, params.estimator == ESTIMATOR_DENSITY); }

/// f cosθ for light from a direction.
vec3 scattered_to_eye(Point x, vec3 direction) {
    if (!x.is_lit || !is_above(x.scatterer, direction)) return vec3(0.0);
    return scattering_value(x.scatterer, x.seen, direction, dot(x.scatterer.n, direction));
}

/// As renderers/passes/lights/equirectangular.h.
vec3 environment(vec3 direction) {
    ivec2 size = textureSize(environment_texture, 0);
    float u = atan(-direction.z, -direction.x) / (2.0 * PI);
    vec2 uv = vec2(u < 0.0 ? u + 1.0 : u, atan(length(direction.xz), direction.y) / PI);
    return texelFetch(environment_texture, min(ivec2(uv * vec2(size)), size - 1), 0).rgb;
}

/// L_dir = Σ f L_in V cosθ Δω.  [Ritschel09 eq. 1]
/// DEVIATION [Ritschel09 eq. 1]: there Δω = 2π / N; here π / Σ cosθ, which tends to it and makes an open plane exact.
vec3 sky_of(Point x, Sample s) {
    if (s.is_occluded) return vec3(0.0);
    return PI / all_cosines(x) * scattered_to_eye(x, s.direction) * environment(s.direction);
}

/// A piece of the eye's ray, t in metres from its point nearest to x, where it is h away; τ = c + t from the eye.
struct Piece {
    float h, t0, t1, c;
};

/// ∫ τ² / (h² + t²) dt over τ² at `seen_at`; for orthographic views without τ.
float inverse_squares(Piece p, float seen_at) {
    if (p.t1 <= p.t0) return 0.0;
    float sum = atan(p.h * (p.t1 - p.t0), p.h * p.h + p.t0 * p.t1) / p.h;
    if (!is_perspective()) return sum;
    float logarithm = log((p.h * p.h + p.t1 * p.t1) / (p.h * p.h + p.t0 * p.t0));
    return ((p.t1 - p.t0) + p.c * logarithm + (p.c * p.c - p.h * p.h) * sum) / (seen_at * seen_at);
}

/// ∫ τ² / (h² + t²)^(3/2) dt likewise, for 0 ≤ t0.
float inverse_cubes_beyond(Piece p, float seen_at) {
    if (p.t1 <= p.t0) return 0.0;
    float r0 = length(vec2(p.h, p.t0)), r1 = length(vec2(p.h, p.t1));
    float sum = (p.t1 - p.t0) * (p.t1 + p.t0) / (r0 * r1 * (p.t1 * r0 + p.t0 * r1));
    if (!is_perspective()) return sum;
    float squares = log((p.t1 + r1) / (p.t0 + r0)) - p.h * p.h * sum, firsts = 1.0 / r0 - 1.0 / r1;
    return max(p.c * p.c * sum + 2.0 * p.c * firsts + squares, 0.0) / (seen_at * seen_at);
}

/// The same without the ball about x that logarithmic lengths leave out.
float inverse_cubes(Piece p, float seen_at) {
    float least = MIN_LENGTH * reach, inner = sqrt(max(least * least - p.h * p.h, 0.0));
    float beyond = inverse_cubes_beyond(Piece(p.h, max(p.t0, inner), p.t1, p.c), seen_at);
    return beyond + inverse_cubes_beyond(Piece(p.h, max(-p.t1, inner), -p.t0, -p.c), seen_at);  // mirrored
}

/// Hidden layers that are seen more edge-on than this cosine count as if seen by it: slivers thinner than a pixel
/// would send as if they filled it.
// C++: ir::methods::ssdo::min_hidden_cosine
const float MIN_HIDDEN_COSINE = 0.1;

/// Density, per area of the seen surface, with which samples of x find the occluder: that of the steps' ends in the
/// hemisphere, 1 / (2π r |s − x|²) or, of logarithmic lengths, 1 / (2π ln(r / least) |s − x|³), integrated over all s
/// behind it on the eye's ray.
/// Steps that end on a piece below r/20 at the rim of the ball count as if it were that long: without a limit rare
/// samples would count without bound. So light fades over the last twentieth of the radius.
float density_of(Point x, Sample s, Occluder o) {
    vec2 place = vec2(s.pixel) + 0.5;
    vec3 v = normalize(pixel_ray_direction(place)), from_occluder = x.position - o.position;
    Piece p;
    p.t0 = -dot(v, from_occluder);
    p.h = max(length(from_occluder + p.t0 * v), 1e-4 * o.distance);
    float rim = sqrt(max(reach * reach - p.h * p.h, 0.0)), falling = -dot(x.geometric_normal, v);
    p.t1 = max(rim, p.t0 + 0.05 * reach);
    if (falling > 0.0) p.t1 = min(p.t1, p.t0 - dot(x.geometric_normal, from_occluder) / falling);
    float seen_at = distance(o.position, pixel_ray_origin(place));
    p.c = seen_at - p.t0;
    float cosine = max(-dot(v, o.facing), o.layer > 0 ? MIN_HIDDEN_COSINE : 0.0);
    float uniform_lengths = inverse_squares(p, seen_at) / reach;
    float logarithmic = inverse_cubes(p, seen_at) / -log(MIN_LENGTH);
    return cosine * 0.5 * (uniform_lengths + logarithmic) / (2.0 * PI);
}

/// The area that a sample's occluder stands for over the square of its distance.
float area_by_distance(Point x, Sample s, Occluder o) {
    if (params.estimator == ESTIMATOR_PUBLISHED) {
        float d = max(o.distance, params.min_distance * reach);
        return params.strength * PI * reach * reach / (float(params.samples) * d * d);
    }
    float density = density_of(x, s, o);
    return density > 0.0 ? 1.0 / (float(params.samples) * density * o.distance * o.distance) : 0.0;
}

/// As printed the layer sends that occludes; by density each that the step found, whatever lies in between.
bool sends(Sample s, Occluder o) {
    bool counts = params.estimator == ESTIMATOR_DENSITY || (s.is_occluded && o.layer == s.layers - 1);
    return counts && o.role == SENDS;
}

/// L_ind = Σ f L_pixel A_s cosθ_s cosθ_r / d².  [Ritschel09 eq. 2]
vec3 sent_by_layer(Point x, Sample s, Occluder o) {
    if (!sends(s, o)) return vec3(0.0);
    return area_by_distance(x, s, o) * o.sending * scattered_to_eye(x, o.to_occluder) *
           light_of_layer(s.pixel, o.layer);
}

/// Of all layers before the step's end; A: how many of them send.
vec4 sent_by(Point x, Sample s) {
    vec4 sum = vec4(0.0);
    for (int layer = 0; layer < s.layers; ++layer) {
        Occluder o = occluder_of(x, s, layer);
        sum += vec4(sent_by_layer(x, s, o), sends(s, o) ? 1.0 : 0.0);
    }
    return sum;
}
