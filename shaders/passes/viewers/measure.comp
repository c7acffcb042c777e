// Of the elements that will be drawn: how many, the range of the number that colours them, and bounds.
#include "passes/viewers/layer.glsl"

layout(local_size_x = 256) in;

// Least and most as keys: unsigned numbers in the order of what they stand for.
layout(std430) buffer Measure {
    uint min, max, count;
    uint numbers;  // bit n: a whole number that is n modulo 32 occurs
    uint lowest[3], highest[3];
} measure;

uniform uint elements_per_invocation;

shared uint group_min, group_max, group_count, group_numbers, group_lowest[3], group_highest[3];

uint key_of(float x) {
    uint bits = floatBitsToUint(x);
    return bits ^ ((bits >> 31) != 0u ? 0xffffffffu : 0x80000000u);
}

uint colour_key(uint base, vec3 position_ws, out bool counts) {
    counts = true;
    if (layer.colour_mode == COLOUR_FIELD && layer.colour_type != TYPE_F32) {
        uint bits = element_words[base + uint(layer.colour_offset)];
        return layer.colour_type == TYPE_U32 ? bits : bits ^ 0x80000000u;
    }
    float x = colour_number(base, position_ws);
    counts = is_finite(x);
    return key_of(x);
}

// Where the element is, and how far it reaches from there along each axis.
bool extent(uint base, out vec3 centre_ws, out vec3 half_size) {
    centre_ws = vector_at(base, layer.place[0]);
    half_size = vec3(0);
    if (layer.primitive == PRIMITIVE_LINES) {
        vec3 end_ws = vector_at(base, layer.place[1]);
        half_size = 0.5 * abs(end_ws - centre_ws);
        centre_ws = 0.5 * (centre_ws + end_ws);
    } else if (layer.primitive == PRIMITIVE_DISCS) {
        half_size = vec3(abs(float_at(base, layer.place[2])));
    } else if (layer.primitive == PRIMITIVE_PARALLELOGRAMS || layer.primitive == PRIMITIVE_ELLIPSOIDS) {
        half_size = abs(vector_at(base, layer.place[1])) + abs(vector_at(base, layer.place[2]));
        if (layer.primitive == PRIMITIVE_ELLIPSOIDS) half_size += abs(vector_at(base, layer.place[3]));
    }
    return is_finite(centre_ws) && is_finite(half_size);
}

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        group_min = 0xffffffffu;
        group_max = group_count = group_numbers = 0u;
        for (int c = 0; c < 3; ++c) {
            group_lowest[c] = 0xffffffffu;
            group_highest[c] = 0u;
        }
    }
    barrier();
    uint least = 0xffffffffu, most = 0u, count = 0u, numbers = 0u;
    vec3 lowest = vec3(uintBitsToFloat(0x7f7fffffu)), highest = -lowest;
    uint first = gl_WorkGroupID.x * gl_WorkGroupSize.x * elements_per_invocation + gl_LocalInvocationIndex;
    for (uint k = 0u; k < elements_per_invocation; ++k) {
        uint i = first + k * gl_WorkGroupSize.x;
        if (i >= layer.drawn) break;
        uint base = element_base(i * layer.step);
        vec3 centre_ws, half_size;
        if (!extent(base, centre_ws, half_size) || !passes_filters(base)) continue;
        ++count;
        lowest = min(lowest, centre_ws - half_size);
        highest = max(highest, centre_ws + half_size);
        if (layer.colour_mode == COLOUR_SINGLE) continue;
        bool counts;
        uint key = colour_key(base, centre_ws, counts);
        if (!counts) continue;
        least = min(least, key);
        most = max(most, key);
        numbers |= 1u << (uint(int(round(colour_number(base, centre_ws)))) & 31u);
    }
    if (count > 0u) {
        atomicAdd(group_count, count);
        atomicMin(group_min, least);
        atomicMax(group_max, most);
        atomicOr(group_numbers, numbers);
        for (int c = 0; c < 3; ++c) {
            atomicMin(group_lowest[c], key_of(lowest[c]));
            atomicMax(group_highest[c], key_of(highest[c]));
        }
    }
    barrier();
    if (gl_LocalInvocationIndex != 0u || group_count == 0u) return;
    atomicAdd(measure.count, group_count);
    atomicMin(measure.min, group_min);
    atomicMax(measure.max, group_max);
    atomicOr(measure.numbers, group_numbers);
    for (int c = 0; c < 3; ++c) {
        atomicMin(measure.lowest[c], group_lowest[c]);
        atomicMax(measure.highest[c], group_highest[c]);
    }
}
