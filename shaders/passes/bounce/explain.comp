// What the picked pixel is made of: its own samples and its neighbours' as lines, with the part of each before it is
// divided by the shares of all. One work group: first the shares, then a line at a time.
layout(local_size_x = 256) in;

#include "passes/bounce/filter.glsl"
#include "passes/bounce/ray_line.glsl"

uniform sampler2DArray distances;

layout(std430) writeonly buffer OwnLines { Line own_lines[]; };
layout(std430) buffer OwnCount { uint own_count; };
layout(std430) writeonly buffer OtherLines { Line other_lines[]; };
layout(std430) buffer OtherCount { uint other_count; };
layout(std430) buffer Shares { float shares; };

uniform ivec2 picked;       // outside: none
uniform int first_sample;   // of the batch
uniform float miss_length;  // m

shared float whole_sums[256];

float whole_share(Target target, int neighbours) {
    float sum = 0.0;
    for (int i = int(gl_LocalInvocationIndex); i < neighbours; i += 256) {
        ivec2 pixel = neighbour(target, i);
        float w = is_inside(pixel) ? neighbour_weight(target, pixel) : 0.0;
        if (w == 0.0) continue;
        for (int s = 0; s < samples; ++s) sum += w * part_at(target, ivec3(pixel, s)).share;
    }
    whole_sums[gl_LocalInvocationIndex] = sum;
    barrier();
    float whole = 0.0;
    for (int i = 0; i < 256; ++i) whole += whole_sums[i];
    return whole;
}

/// What the pixel's own sample adds beside those of all neighbours.
Value value_beside_all(Target target, int number) {
    Value sum = Value(0.0);
    int across = 2 * radius + 1;
    for (int i = 0; i < across * across; ++i) {
        ivec2 pixel = neighbour(target, i);
        float w = is_inside(pixel) ? neighbour_weight(target, pixel) : 0.0;
        if (w > 0.0) sum += w * value_beside(target, beside(target, pixel), number);
    }
    return sum;
}

Line line_of(Target target, ivec2 pixel, int number, float weight) {
    ivec3 place = ivec3(pixel, number);
    vec4 direction = texelFetch(directions, place, 0);
    float met = texelFetch(distances, place, 0).x;
    vec3 start = receiver_at(pixel).position, end = start + (met < 0.0 ? miss_length : met) * direction.xyz;
    Line line;
    for (int i = 0; i < 3; ++i) {
        line.start[i] = start[i];
        line.end[i] = end[i];
    }
    line.distance_m = met;
    line.density = direction.w;
    Value arriving = incoming_at(place, direction), part = weight * part_at(target, place).value;
    if (pixel == target.pixel) part += value_beside_all(target, number);
#if LIGHT
    for (int i = 0; i < CHANNELS; ++i) {
        line.incoming[i] = arriving[i];
        line.contribution[i] = part[i];
    }
#else
    line.incoming[0] = arriving;
    line.contribution[0] = part;
#endif
    line.weight = weight;
    line.apart = length(vec2(pixel - target.pixel));
    line.hit = met < 0.0 ? 0u : 1u;
    line.sample_ = uint(first_sample + number);
    return line;
}

void store_own(Line line) {
    uint index = atomicAdd(own_count, 1u);
    if (index < own_lines.length()) own_lines[index] = line;
}

void store_other(Line line) {
    uint index = atomicAdd(other_count, 1u);
    if (index < other_lines.length()) other_lines[index] = line;
}

void main() {
    Target target;
    if (picked.x < 0 || !target_at(picked, target)) return;
    int across = 2 * radius + 1, neighbours = across * across;
    float whole = whole_share(target, neighbours);
    if (gl_LocalInvocationIndex == 0u) shares += whole;
    if (whole == 0.0) return;
    for (int i = int(gl_LocalInvocationIndex); i < neighbours; i += 256) {
        ivec2 pixel = neighbour(target, i);
        float w = is_inside(pixel) ? neighbour_weight(target, pixel) : 0.0;
        if (w == 0.0) continue;
        for (int s = 0; s < samples; ++s) {
            if (texelFetch(directions, ivec3(pixel, s), 0).w == 0.0) continue;
            Line line = line_of(target, pixel, s, w);
            if (pixel == picked) store_own(line);
            else store_other(line);
        }
    }
}
