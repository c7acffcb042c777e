// How many points of the emission sets each layer of the RSM gets: in proportion to weights, by largest
// remainders, so that the parts sum to the number of points. Behind the layers come the sources that rays were
// traced from. One invocation.
layout(local_size_x = 1) in;
#include "methods/photon-mapping/records.glsl"

layout(std430) buffer Sources { Source sources[]; };
layout(std430) buffer WithoutPoints { uint sources_without_points; };
#if TRACED
layout(std430) readonly buffer TracedSources { Source traced_sources[]; };
uniform uint traced_count;
#endif
#if BY_PROBABILITY
uniform sampler2DArray haar_pyramid;
uniform int levels;
#endif

uniform uint points, source_count;

/// Layers that a sample point's record can name (6 bits).
// C++: ir::methods::photon_mapping::max_layers
const int MAX_LAYERS = 64;

float weight_of(uint source) {
    float weight = max(sources[source].flux, 0.0);
#if BY_PROBABILITY
    weight *= texelFetch(haar_pyramid, ivec3(0, 0, source), levels - 1).r;
#endif
    return isinf(weight) || isnan(weight) ? 0.0 : weight;
}

void main() {
    float weights[MAX_LAYERS], remainders[MAX_LAYERS];
    float sum = 0.0;
    for (uint i = 0u; i < source_count; ++i) {
        weights[i] = weight_of(i);
        sum += weights[i];
    }
    uint given = 0u;
    for (uint i = 0u; i < source_count; ++i) {
        float share = sum > 0.0 ? float(points) * (weights[i] / sum) : 0.0;
        uint whole = min(uint(share), points - given);
        remainders[i] = weights[i] > 0.0 ? share - float(whole) : -1.0;
        sources[i].points = whole;
        given += whole;
    }
    // at most one each by remainders; rounding of large numbers may leave more
    while (sum > 0.0 && given < points) {
        uint next = 0u;
        for (uint i = 1u; i < source_count; ++i)
            if (remainders[i] > remainders[next]) next = i;
        ++sources[next].points;
        remainders[next] -= 1.0;
        ++given;
    }
    uint first = 0u;
    for (uint i = 0u; i < source_count; ++i) {
        sources[i].first_point = first;
        first += sources[i].points;
        if (weights[i] > 0.0 && sources[i].points == 0u) atomicAdd(sources_without_points, 1u);
    }
#if TRACED
    for (uint i = 0u; i < traced_count; ++i) {
        sources[source_count + i] = traced_sources[i];
        if (traced_sources[i].flux > 0.0 && traced_sources[i].points == 0u) atomicAdd(sources_without_points, 1u);
    }
#endif
}
