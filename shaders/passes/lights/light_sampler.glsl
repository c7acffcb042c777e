// Which source a sample is spent on, and where on it: passes::LightSampler (renderers/passes/lights/light_sampler.h)
// without lights that have no extent. `normal_ws`: the point's unit geometric normal.
#include "lib/coverage.glsl"
#include "lib/point_sequence.glsl"
#include "passes/lights/light_pdfs.glsl"

/// `choice` with more than its 24 bits, which would not last to the leaves of a deep tree: the rest are a hash of all
/// the numbers given.
double lengthened(float choice, vec2 u) {
    uvec2 bits = uvec2(floatBitsToUint(u.y), floatBitsToUint(u.x)) ^
                 product64(uvec2(floatBitsToUint(choice), 0u), uvec2(0x7f4a7c15u, 0x9e3779b9u));
    bits = product64(folded64(bits, 30), uvec2(0x1ce4e5b9u, 0xbf58476du));  // [Steele14]
    bits = product64(folded64(bits, 27), uvec2(0x133111ebu, 0x94d049bbu));
    const double unit = 5.9604644775390625e-8lf, part = 2.3283064365386963e-10lf;
    return min(double(choice) + unit * (double(bits.y) * part), 1.0lf - 1.1102230246251565e-16lf);
}

/// Barycentric coordinates uniform in area: the unit square's lower half is folded onto its upper half along the
/// diagonal, which keeps neighbours together.  [Heitz19]
vec2 low_distortion_map(vec2 u) {
    return u.y > u.x ? vec2(0.5 * u.x, u.y - 0.5 * u.x) : vec2(u.x - 0.5 * u.y, 0.5 * u.y);
}

/// Uniformly in area; nothing in the holes of alpha masks.
LightSample sample_triangle(EmissiveTriangle t, vec3 position_ws, vec2 u) {
    vec2 at = low_distortion_map(u);
    if (t.mask != 0u && !is_covered(t.mask - 1u, uv_at(t.mask_uv, at))) return NO_LIGHT_SAMPLE;
    vec3 radiance = emission_at(t, at);
    if (radiance == vec3(0)) return NO_LIGHT_SAMPLE;
    vec3 offset = t.corner_ws + at.x * t.edge_u_ws + at.y * t.edge_v_ws - position_ws;
    float distance = length(offset);
    return LightSample(offset / distance, distance, radiance, pdf_on_triangle(t, position_ws, at));
}

/// `choice` and `u` uniform in [0, 1).
LightSample sample_source(SourceTotals sources, vec3 position_ws, vec3 normal_ws, float choice, vec2 u) {
    double left = lengthened(choice, u) * double(sources.tree_weight + sources.environment_weight);
    LightSample s;
    float probability;
    if (left < double(sources.tree_weight)) {
        ChosenSource chosen = choose_in_tree(position_ws, normal_ws, left / double(sources.tree_weight));
        if (!(chosen.probability > 0.0)) return NO_LIGHT_SAMPLE;
        probability = chosen.probability * share_of(sources, sources.tree_weight);
        if (chosen.source < sources.lamps)
            s = sample_lamp(lamps[chosen.source], position_ws, u);
        else
            s = sample_triangle(emissive_triangles[chosen.source - sources.lamps], position_ws, u);
    } else {
        if (!has_environment(sources)) return NO_LIGHT_SAMPLE;  // by rounding
        probability = share_of(sources, sources.environment_weight);
        s = sample_sky(sources, normal_ws, u);
    }
    s.pdf *= probability;
    return s.pdf > 0.0 && is_finite(s.pdf) ? s : NO_LIGHT_SAMPLE;
}

/// False only where a ray along a unit direction meets no source, whatever is in between.
bool may_meet(SourceTotals sources, vec3 origin_ws, vec3 direction_ws) {
    if (has_environment(sources)) return true;
    if (sources.triangles > 0u && may_meet_in_tree(origin_ws, direction_ws)) return true;
    for (uint i = 0u; i < sources.lamps; ++i)
        if (lamp_distance(lamps[i], origin_ws, direction_ws) < NOT_MET) return true;
    return false;
}
