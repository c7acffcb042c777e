// Adds a footprint to the picture without a rasteriser, from any compute shader. Include after #extension
// GL_NV_shader_atomic_float where FLOAT_ATOMICS is set; others compare and swap. The order of the sums, and with it
// their rounding, is that in which invocations happen to run.
#include "methods/ldm-indirect/seen.glsl"
#include "methods/ldm-indirect/splatting/kernel.glsl"
#include "methods/ldm-indirect/splatting/outline.glsl"
#ifdef CLIPPED
#include "methods/ldm-indirect/splatting/clipping.glsl"
#endif

/// Layers: R, G, B (W/m²), photons, sum of directions.
#ifdef FLOAT_ATOMICS
layout(r32f) uniform image2DArray sums;
void atomic_add(ivec3 texel, float value) { imageAtomicAdd(sums, texel, value); }
#else
layout(r32ui) uniform uimage2DArray sums;
void atomic_add(ivec3 texel, float value) {
    uint seen = imageLoad(sums, texel).x, expected;
    do {
        expected = seen;
        seen = imageAtomicCompSwap(sums, texel, expected, floatBitsToUint(uintBitsToFloat(expected) + value));
    } while (seen != expected);
}
#endif

void add_at(Kernel k, ivec2 pixel) {
    vec3 position_ws = texelFetch(gbuffer_position, pixel, 0).xyz;
    vec3 normal_ws = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz, irradiance;
    if (normal_ws == vec3(0) || !add_kernel(k, position_ws, normal_ws, irradiance)) return;
#ifdef CLIPPED
    if (!is_lit(k, pixel, textureSize(gbuffer_position, 0), position_ws)) return;
#endif
    for (int c = 0; c < 3; ++c) atomic_add(ivec3(pixel, c), irradiance[c]);
    atomic_add(ivec3(pixel, 3), 1.0);
    vec3 direction = direction_of(k, irradiance);
    for (int c = 0; c < 3; ++c) atomic_add(ivec3(pixel, 4 + c), direction[c]);
}

/// The pixels first, first + step, … before end of the footprint's rectangle, counted row by row.
void splat_atomically(Footprint f, uint first, uint step, uint end) {
    if (!f.counts) return;
    Outline o = outline_of(f);
    if (!is_in_view(o)) return;
    Kernel k = kernel_of(f);
    ivec4 bounds = pixels_of(o);
    uvec2 size = uvec2(bounds.zw - bounds.xy + 1);
    for (uint i = first; i < min(end, size.x * size.y); i += step)
        add_at(k, bounds.xy + ivec2(i % size.x, i / size.x));
}
