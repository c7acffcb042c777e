// The average of a pixel over frames, followed along its motion. VARIANCE: A is that of the frames' values, which are
// independent. [Scherzer12]
#include "lib/floats.glsl"
#include "lib/pixel_rays.glsl"  // of the previous view
#include "lib/spaces.glsl"
#include "passes/bounce/tiles.glsl"

uniform sampler2D now;
uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_geometric_normal;  // w: depth in the previous view
uniform sampler2D gbuffer_velocity;
uniform sampler2D previous_average;
uniform usampler2D previous_surfaces;
uniform sampler2D previous_frames;
uniform writeonly image2D average;
layout(rg32ui) uniform writeonly uimage2D surfaces;
layout(r32f) uniform writeonly image2D frames;

uniform bool has_history;
uniform float history;
uniform vec4 depth_row;  // of a homogeneous point: its depth along this view's axis

const float NO_SURFACE = uintBitsToFloat(0x7f800000u);
/// Least cosine between normals of what is taken for the same surface: 26 degrees, so that curved ones keep it.
const float MIN_COSINE = 0.9;
/// Rounding of depths, as part of them.
const float DEPTH_EPSILON = 1e-3;
const float MAX_FRAMES = 65535.0;

struct History {
    vec4 value;
    float frames;  // 0: there is none
};


/// In the previous view, of a place in its picture.
vec3 point_at(vec2 position_px, float depth) {
    return pixel_ray_origin(position_px) + depth * pixel_ray_direction(position_px);
}

/// The texel shows the surface on which `point` lay: within a pixel's width of its plane, and facing the same way.
bool is_same(uvec2 stored, ivec2 texel, vec3 point, vec3 normal, float tolerance) {
    float depth = uintBitsToFloat(stored.y);
    if (!(depth < NO_SURFACE) || dot(unpacked_direction(stored.x), normal) < MIN_COSINE) return false;
    return abs(dot(normal, point_at(vec2(texel) + 0.5, depth) - point)) <= tolerance;
}

/// Bilinear, among the texels of the same surface.
History history_of(ivec2 pixel, vec4 geometric_normal) {
    History found = History(vec4(0.0), 0.0);
    float depth = geometric_normal.w;
    if (!has_history || !(depth > 0.0)) return found;
    vec2 q = vec2(pixel) + 0.5 - texelFetch(gbuffer_velocity, pixel, 0).xy;
    // Rounded to 1/256, as texture filters do it, so that a velocity's rounding does not blur what stands.
    vec2 place = round((q - 0.5) * 256.0) / 256.0, base = floor(place), f = place - base;
    vec3 point = point_at(q, depth);
    float tolerance = length(ray_origin_dx + depth * ray_direction_dx) + DEPTH_EPSILON * depth;
    ivec2 size = textureSize(previous_average, 0);
    float shares = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1), texel = ivec2(clamp(base, vec2(-2.0), vec2(size))) + corner;
        vec2 part = mix(1.0 - f, f, vec2(corner));
        float share = part.x * part.y;
        if (share == 0.0 || any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size))) continue;
        uvec2 stored = texelFetch(previous_surfaces, texel, 0).xy;
        vec4 value = texelFetch(previous_average, texel, 0);
        if (!is_same(stored, texel, point, geometric_normal.xyz, tolerance) || !is_finite(value)) continue;
        found.value += share * value;
        found.frames += share * texelFetch(previous_frames, texel, 0).x;
        shares += share;
    }
    if (shares == 0.0) return found;
    return History(found.value / shares, found.frames / shares);
}

void main() {
    ivec2 pixel = tile_pixel();
    if (any(greaterThanEqual(pixel, imageSize(average)))) return;
    vec4 value = texelFetch(now, pixel, 0);
    vec4 geometric_normal = texelFetch(gbuffer_geometric_normal, pixel, 0);
    bool exists = geometric_normal.xyz != vec3(0.0);
    float count = exists ? 1.0 : 0.0, depth = NO_SURFACE;
    if (exists) {
        depth = dot(depth_row, vec4(texelFetch(gbuffer_position, pixel, 0).xyz, 1.0));
        History before = history_of(pixel, geometric_normal);
        if (before.frames > 0.0) {
            // n frames' mean keeps (n - 1) / n of that before, an exponential average never more than `history`.
            float kept = min(before.frames / (before.frames + 1.0), history);
            vec4 mean = value + kept * (before.value - value);
#if VARIANCE
            mean.a = (1.0 - kept) * (1.0 - kept) * value.a + kept * kept * before.value.a;
#endif
            value = is_finite(value) ? mean : before.value;
            count = min(before.frames + 1.0, MAX_FRAMES);
        }
    }
    imageStore(average, pixel, value);
    uint normal = exists ? packed_direction(geometric_normal.xyz) : 0u;
    imageStore(surfaces, pixel, uvec4(normal, floatBitsToUint(depth), 0u, 0u));
    imageStore(frames, pixel, vec4(count));
}
