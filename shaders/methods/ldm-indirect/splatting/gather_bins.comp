// Sums the kernels of a bin's photons over its pixels: a work group for each tile, which reads the photons together.
#include "methods/ldm-indirect/splatting/kernel.glsl"

const uint staged = 128u;

layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, binding = 0) readonly buffer Photons { Photon photons[]; };
layout(std430, binding = 3) readonly buffer Places { uint places[]; };
layout(std430, binding = 4) readonly buffer Lists { uint lists[]; };
layout(binding = 0) uniform sampler2D position_image;
layout(binding = 1) uniform sampler2D normal_image;  // geometric
layout(rgba32f, binding = 0) uniform image2D sums;

uniform uint tiles_across, bins_across, first_tile;
uniform uint round_first, round_size;  // entries of each list

shared vec3 centres[staged], rows_p[staged], rows_q[staged], rows_n[staged], peaks[staged], sources[staged];

void stage(uint lane, uint entry) {
    Kernel k = kernel_of(footprint_of(photons[lists[entry]]));
    centres[lane] = k.centre_ws;
    rows_p[lane] = k.row_p;
    rows_q[lane] = k.row_q;
    rows_n[lane] = k.row_n;
    peaks[lane] = k.peak;
    sources[lane] = k.to_source_ws;
}

vec4 sum_of_staged(uint count, vec3 position_ws, vec3 normal_ws) {
    vec4 sum = vec4(0);
    for (uint j = 0u; j < count; ++j) {
        vec3 irradiance;
        Kernel k = Kernel(centres[j], rows_p[j], rows_q[j], rows_n[j], peaks[j], sources[j]);
        if (add_kernel(k, position_ws, normal_ws, irradiance)) sum += vec4(irradiance, 1);
    }
    return sum;
}

void main() {
    uint tile = first_tile + gl_WorkGroupID.x;
    uvec2 at = uvec2(tile % tiles_across, tile / tiles_across) * 16u;
    uint bin = at.y / BIN * bins_across + at.x / BIN;
    uint begin = bin == 0u ? 0u : places[bin * COLUMNS - 1u];
    uint end = min(places[bin * COLUMNS + COLUMNS - 1u], uint(lists.length()));
    begin += round_first;
    end = min(end, begin + round_size);
    if (begin >= end) return;
    ivec2 pixel = ivec2(at + gl_LocalInvocationID.xy);
    bool inside = all(lessThan(pixel, imageSize(sums)));
    vec3 normal_ws = inside ? texelFetch(normal_image, pixel, 0).xyz : vec3(0);
    vec3 position_ws = inside ? texelFetch(position_image, pixel, 0).xyz : vec3(0);
    bool lit = normal_ws != vec3(0);
    vec4 sum = inside ? imageLoad(sums, pixel) : vec4(0);
    uint lane = gl_LocalInvocationIndex;
    for (uint entry = begin; entry < end; entry += staged) {
        uint count = min(staged, end - entry);
        if (lane < count) stage(lane, entry + lane);
        barrier();
        if (lit) sum += sum_of_staged(count, position_ws, normal_ws);
        barrier();
    }
    if (inside) imageStore(sums, pixel, sum);
}
