// Sums the kernels of a bin's photons over its pixels. An invocation sums ROWS pixels of a column: what it reads of a
// kernel serves all of them, which is most of the time where buffers are read lane by lane.
#include "methods/ldm-indirect/seen.glsl"
#include "methods/ldm-indirect/splatting/packed_kernel.glsl"
#include "passes/photons/binned.glsl"

#ifdef CLIPPED
#include "methods/ldm-indirect/splatting/clipping.glsl"
#endif

layout(local_size_x = GATHERED_TILE, local_size_y = GATHERED_TILE / ROWS) in;
layout(std430) readonly buffer Kernels { PackedKernel kernels[]; };
layout(rgba32f) uniform image2D sums;
layout(rgba32f) uniform image2D directions;

void main() {
    uvec2 at = corner_of_tile(), entries = entries_of(at);
    if (entries.x >= entries.y) return;
    ivec2 first = ivec2(at + gl_LocalInvocationID.xy * uvec2(1, ROWS)), size = imageSize(sums);
    vec3 position_ws[ROWS], normal_ws[ROWS], direction[ROWS];
    vec4 sum[ROWS];
    for (int i = 0; i < ROWS; ++i) {
        ivec2 pixel = first + ivec2(0, i);
        bool inside = all(lessThan(pixel, size));
        normal_ws[i] = inside ? texelFetch(gbuffer_geometric_normal, pixel, 0).xyz : vec3(0);  // 0: faces no light
        position_ws[i] = inside ? texelFetch(gbuffer_position, pixel, 0).xyz : vec3(0);
        sum[i] = inside ? imageLoad(sums, pixel) : vec4(0);
        direction[i] = inside ? imageLoad(directions, pixel).xyz : vec3(0);
    }
    for (uint entry = entries.x; entry < entries.y; ++entry) {
        Kernel k = unpacked_kernel(kernels[lists[entry]]);
        for (int i = 0; i < ROWS; ++i) {
            vec3 irradiance;
            if (!add_kernel(k, position_ws[i], normal_ws[i], irradiance)) continue;
#ifdef CLIPPED
            if (!is_lit(k, first + ivec2(0, i), size, position_ws[i])) continue;
#endif
            sum[i] += vec4(irradiance, 1);
            direction[i] += direction_of(k, irradiance);
        }
    }
    for (int i = 0; i < ROWS; ++i) {
        ivec2 pixel = first + ivec2(0, i);
        if (any(greaterThanEqual(pixel, size))) continue;
        imageStore(sums, pixel, sum[i]);
        imageStore(directions, pixel, vec4(direction[i], 0));
    }
}
