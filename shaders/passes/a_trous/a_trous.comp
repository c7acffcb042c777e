// One level of the edge-avoiding à-trous transform: S_{i+1} from S_i, and the clipped detail between them.
// VIEW: writes what it is called after (SCALING, DETAIL, CLIPPED, BOUND) into layer `layer` instead; INPUT is
// S_i itself.  [Smal19 §7.3; Dammertz10]
// GUIDED: no details; the fourth channel is the variance of the luminance, which says how far neighbours may
// differ, and is filtered too.  [Schied17 §4.3]
//
// A group takes pixels that are `stride` apart, so that the neighbours of all levels alike are 20 × 20 texels
// of shared memory: 1.6 reads of each image a pixel instead of 25.
// A software rasteriser gains nothing by it: 3.1 to 5.8 s a pass at 1920 × 1080 with it, 3.3 to 3.8 s without.
layout(local_size_x = 16, local_size_y = 16) in;

#include "passes/a_trous/surface.glsl"

uniform sampler2D value_image;  // a: x of the direction; GUIDED: variance
uniform usampler2D surfaces;
#ifdef GUIDED
#include "lib/luminance.glsl"
#else
uniform sampler2D direction_image;  // y and z of the direction
#endif

#define INPUT 0
#define SCALING 1
#define DETAIL 2
#define CLIPPED 3
#define BOUND 4

#ifdef VIEW
layout(rgba32f) uniform writeonly image2DArray view;
uniform int layer;
#elif defined(GUIDED)
layout(rgba32f) uniform writeonly image2D next_value;
#else
layout(rgba32f) uniform image2D value_sum;  // Σ of clipped details; in the last pass the result
layout(rg32f) uniform image2D direction_sum;
#ifndef LAST
layout(rgba32f) uniform writeonly image2D next_value;
layout(rg32f) uniform writeonly image2D next_direction;
#endif
#endif

uniform int pixel_stride, first_row;
uniform float detail_clip, sigma_value;

#ifdef B3_SPLINE
const float KERNEL[3] = B3_SPLINE_KERNEL;
#else
const float KERNEL[3] = PRINTED_KERNEL;
#endif

const int GROUP = 16, SIDE = GROUP + 2 * KERNEL_RADIUS;
shared vec4 tile_value[SIDE * SIDE];
#ifndef GUIDED
shared vec2 tile_direction[SIDE * SIDE];
#endif
shared vec4 tile_surface[SIDE * SIDE];

/// The pixel at the group's corner: groups of one block of GROUP·stride pixels take turns of its pixels.
ivec2 group_corner() {
    ivec2 group = ivec2(gl_WorkGroupID.xy) + ivec2(0, first_row);
    return group / pixel_stride * (GROUP * pixel_stride) + group % pixel_stride;
}

void load_tile(ivec2 corner) {
    ivec2 size = textureSize(surfaces, 0);
    for (int i = int(gl_LocalInvocationIndex); i < SIDE * SIDE; i += GROUP * GROUP) {
        ivec2 at = corner + (ivec2(i % SIDE, i / SIDE) - KERNEL_RADIUS) * pixel_stride;
        tile_surface[i] = vec4(0, 0, 0, NO_SURFACE);
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
        FilterSurface s = unpacked_surface(texelFetch(surfaces, at, 0).xy);
        tile_surface[i] = vec4(s.normal, s.depth);
        tile_value[i] = texelFetch(value_image, at, 0);
#ifndef GUIDED
        tile_direction[i] = texelFetch(direction_image, at, 0).xy;
#endif
    }
}

/// Kernel and edges: of the neighbour at `offset`, whose surface is `q`.
float weight(FilterSurface p, vec4 q, vec2 gradient, ivec2 offset) {
    float expected = dot(gradient, vec2(offset));
    return KERNEL[abs(offset.x)] * KERNEL[abs(offset.y)] * normal_weight(p.normal, q.xyz) *
           depth_weight(q.w - p.depth - expected, abs(expected), p.depth);
}

#ifdef GUIDED

/// Variance of the centre, smoothed over 3 × 3 pixels: that of a few samples is noise itself.
float smooth_variance(int centre) {
    float total = 0.0, sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            int i = centre + y * SIDE + x;
            if (tile_surface[i].w == NO_SURFACE) continue;
            float w = (2.0 - abs(float(x))) * (2.0 - abs(float(y)));
            total += w;
            sum += w * tile_value[i].a;
        }
    return sum / total;
}

/// Mean with weights w h, w falling with the difference of luminances in standard errors; and its variance,
/// Σ (w h)² σ² / (Σ w h)².  [Schied17 eqs. 2, 5]
vec4 guided(int centre, vec2 position_px) {
    FilterSurface p = FilterSurface(tile_surface[centre].xyz, tile_surface[centre].w);
    vec2 gradient = depth_gradient(p, position_px) * float(pixel_stride);
    vec4 value = tile_value[centre];
    float own = luminance(value.rgb), total = KERNEL[0] * KERNEL[0];
    float tolerance = sigma_value * sqrt(max(smooth_variance(centre), 0.0)) + 1e-6 * own + 1e-20;
    vec4 sum = vec4(total * value.rgb, total * total * value.a);
    for (int y = -KERNEL_RADIUS; y <= KERNEL_RADIUS; ++y)
        for (int x = -KERNEL_RADIUS; x <= KERNEL_RADIUS; ++x) {
            int i = centre + y * SIDE + x;
            vec4 q = tile_surface[i];
            if (i == centre || q.w == NO_SURFACE) continue;
            vec4 other = tile_value[i];
            float w = weight(p, q, gradient, ivec2(x, y)) * exp(-abs(luminance(other.rgb) - own) / tolerance);
            total += w;
            sum += vec4(w * other.rgb, w * w * other.a);
        }
    return sum / vec4(vec3(total), total * total);
}

#else

struct Level {
    vec4 value_shift, value_bound;  // S_{i+1} - S_i, and CSB
    vec2 direction_shift, direction_bound;
};

/// Moments about the centre's value, which are exact where the picture is constant: with C = S_i(q) - S_i(p),
/// S_{i+1} - S_i = M1/w and σ² = M2/w - (M1/w)².  [Smal19 eqs. 7.5, 7.7]
Level filtered(int centre, vec2 position_px) {
    FilterSurface p = FilterSurface(tile_surface[centre].xyz, tile_surface[centre].w);
    vec2 gradient = depth_gradient(p, position_px) * float(pixel_stride);
    float total = KERNEL[0] * KERNEL[0];
    vec4 m1 = vec4(0), m2 = vec4(0);
    vec2 direction_m1 = vec2(0), direction_m2 = vec2(0);
    for (int y = -KERNEL_RADIUS; y <= KERNEL_RADIUS; ++y)
        for (int x = -KERNEL_RADIUS; x <= KERNEL_RADIUS; ++x) {
            int i = centre + y * SIDE + x;
            vec4 q = tile_surface[i];
            if (i == centre || q.w == NO_SURFACE) continue;
            float w = weight(p, q, gradient, ivec2(x, y));
            vec4 c = tile_value[i] - tile_value[centre];
            vec2 d = tile_direction[i] - tile_direction[centre];
            total += w;
            m1 += w * c;
            m2 += w * c * c;
            direction_m1 += w * d;
            direction_m2 += w * d * d;
        }
    m1 /= total;
    direction_m1 /= total;
    return Level(m1, detail_clip * sqrt(max(m2 / total - m1 * m1, vec4(0))), direction_m1,
                 detail_clip * sqrt(max(direction_m2 / total - direction_m1 * direction_m1, vec2(0))));
}

#endif

#ifndef GUIDED
/// D_i within its bounds. BOUNDS_DARK_DETAILS: the lower one is no more than 4 γ S_i.
vec4 clipped_detail(Level level, vec4 value) {
    vec4 lower = level.value_bound;
#ifdef BOUNDS_DARK_DETAILS
    lower.rgb = min(lower.rgb, 4.0 * detail_clip * max(value.rgb, vec3(0)));
#endif
    return clamp(-level.value_shift, -lower, level.value_bound);
}
#endif

#ifdef GUIDED

void store_nothing(ivec2 pixel) { imageStore(next_value, pixel, vec4(0)); }

#elif defined(VIEW)

void store(ivec2 pixel, int centre, Level level) {
#if VIEW == INPUT
    vec4 shown = tile_value[centre];
#elif VIEW == SCALING
    vec4 shown = tile_value[centre] + level.value_shift;
#elif VIEW == DETAIL
    vec4 shown = -level.value_shift;
#elif VIEW == CLIPPED
    vec4 shown = clipped_detail(level, tile_value[centre]);
#else
    vec4 shown = level.value_bound;
#endif
    imageStore(view, ivec3(pixel, layer), shown);
}

void store_nothing(ivec2 pixel) { imageStore(view, ivec3(pixel, layer), vec4(0)); }

#else

/// D_i = S_i - S_{i+1}, E = S_N + Σ clamp(D_i, -CSB_i, CSB_i).
/// DEVIATION [Smal19 eqs. 7.6, 7.8]: the print subtracts the sum, and has the clamp's arguments in another
/// order. With its sign even unclipped details do not give the input back.
void store(ivec2 pixel, int centre, Level level) {
    vec4 value = clipped_detail(level, tile_value[centre]);
    vec2 direction = clamp(-level.direction_shift, -level.direction_bound, level.direction_bound);
#ifndef FIRST
    value += imageLoad(value_sum, pixel);
    direction += imageLoad(direction_sum, pixel).xy;
#endif
    vec4 next = tile_value[centre] + level.value_shift;
    vec2 next_d = tile_direction[centre] + level.direction_shift;
#ifdef LAST
    value += next;
    direction += next_d;
#else
    imageStore(next_value, pixel, next);
    imageStore(next_direction, pixel, vec4(next_d, 0, 0));
#endif
    imageStore(value_sum, pixel, value);
    imageStore(direction_sum, pixel, vec4(direction, 0, 0));
}

void store_nothing(ivec2 pixel) {
    imageStore(value_sum, pixel, vec4(0));
    imageStore(direction_sum, pixel, vec4(0));
#ifndef LAST
    imageStore(next_value, pixel, vec4(0));
    imageStore(next_direction, pixel, vec4(0));
#endif
}

#endif

void main() {
    ivec2 corner = group_corner(), local = ivec2(gl_LocalInvocationID.xy);
    load_tile(corner);
    barrier();
    ivec2 pixel = corner + local * pixel_stride;
    if (any(greaterThanEqual(pixel, textureSize(surfaces, 0)))) return;
    int centre = (local.y + KERNEL_RADIUS) * SIDE + local.x + KERNEL_RADIUS;
    if (tile_surface[centre].w == NO_SURFACE)
        store_nothing(pixel);
    else
#ifdef GUIDED
        imageStore(next_value, pixel, guided(centre, vec2(pixel) + 0.5));
#else
        store(pixel, centre, filtered(centre, vec2(pixel) + 0.5));
#endif
}
