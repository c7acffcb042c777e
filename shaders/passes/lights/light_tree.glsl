// Chooses among many sources by what they may send to a point: passes::LightTree
// (renderers/passes/lights/light_tree.h).  [Conty18]
#include "passes/lights/sources.glsl"
#include "passes/raytracing/ray_offset.glsl"

/// cos and sin of max(0, a - b) for angles from 0 to π, given by their own.
vec2 reduced(vec2 a, vec2 b) {
    if (a.x >= b.x) return vec2(1, 0);
    return vec2(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y);
}
vec2 with_cosine(float cosine) { return vec2(cosine, sqrt(max(1.0 - cosine * cosine, 0.0))); }

/// Bound of the irradiance from the group: intensity * cos θ' * cos θi' / distance², the angles the least that any
/// of its sources may have.  [Conty18 §5]
float importance(LightNode node, vec3 position_ws, vec3 normal_ws) {
    const float min_squared_distance = 1e-16;  // keeps the quotient finite
    vec3 offset = position_ws - node.centre;
    float squared = dot(offset, offset);
    if (squared <= node.squared_radius) return node.intensity / max(node.squared_radius, min_squared_distance);
    vec3 direction = offset / sqrt(squared);
    float sine_squared = node.squared_radius / squared;
    vec2 box = vec2(sqrt(1.0 - sine_squared), sqrt(sine_squared));
    float cosine = dot(node.axis, direction);
    if (node.two_sided != 0u) cosine = abs(cosine);
    vec2 beyond_normals = reduced(with_cosine(cosine), vec2(node.cos_normals, node.sin_normals));
    float cos_emitted = reduced(beyond_normals, box).x;
    if (cos_emitted <= node.cos_emission) return 0.0;
    float received = max(reduced(with_cosine(-dot(direction, normal_ws)), box).x, 0.0);
    return node.intensity * cos_emitted / max(squared, min_squared_distance) * received;
}

/// Probability 0: none.
struct ChosenSource {
    uint source;
    float probability;
};

/// `u` uniform in [0, 1), with bits to spare: each level uses up some. `normal_ws` is the plane's.
ChosenSource choose_in_tree(vec3 position_ws, vec3 normal_ws, double u) {
    const double below_one = 1.0lf - 1.1102230246251565e-16lf;
    uint at = 0u;
    float probability = 1.0;
    while (light_nodes[at].children > 0u) {
        uint first = light_nodes[at].first_child, count = min(light_nodes[at].children, MAX_LIGHT_CHILDREN);
        float weights[MAX_LIGHT_CHILDREN];
        float sum = 0.0;
        for (uint i = 0u; i < count; ++i)
            sum += weights[i] = importance(light_nodes[first + i], position_ws, normal_ws);
        if (!(sum > 0.0)) return ChosenSource(0u, 0.0);
        double left = u * double(sum);
        float part = 0.0;
        uint chosen = 0u;
        for (uint i = 0u; i < count; ++i) {
            if (!(weights[i] > 0.0)) continue;
            left -= double(part);
            part = weights[i];
            chosen = i;
            if (left < double(part)) break;
        }
        u = clamp(left / double(part), 0.0lf, below_one);
        probability *= part / sum;
        at = first + chosen;
    }
    return ChosenSource(light_nodes[at].source, probability);
}

/// With which choose_in_tree() chooses the source of a node.
float probability_in_tree(vec3 position_ws, vec3 normal_ws, uint node) {
    if (node == NO_LIGHT_NODE) return 0.0;
    float probability = 1.0;
    while (light_nodes[node].parent != node) {
        uint parent = light_nodes[node].parent;
        float own = importance(light_nodes[node], position_ws, normal_ws);
        if (!(own > 0.0)) return 0.0;
        uint first = light_nodes[parent].first_child, count = light_nodes[parent].children;
        float sum = 0.0;
        for (uint i = 0u; i < count; ++i) sum += importance(light_nodes[first + i], position_ws, normal_ws);
        probability *= own / sum;
        node = parent;
    }
    return probability;
}

/// A group's room for rounding, as a part of what is computed with.
// C++: ir::passes::meeting_room
const float MEETING_ROOM = 1e-4;

/// Whether a ray along a unit direction may meet the group, also one that is moved aside as far as rays are that
/// start anew at panes.
bool may_meet_group(LightNode node, vec3 origin_ws, vec3 direction_ws) {
    vec3 offset = node.centre - origin_ws;
    float reach = sqrt(node.squared_radius) + float(MAX_PANES) * MIN_RAY_OFFSET_M +
                  MEETING_ROOM * (length(offset) + length(node.centre));
    // where the ray comes closest to the centre
    vec3 closest = offset - max(dot(offset, direction_ws), 0.0) * direction_ws;
    return dot(closest, closest) <= reach * reach;
}

/// Nodes that a ray reads; with the loop within below the 65,535 turns after which llvmpipe ends loops.
const uint MAX_LIGHT_NODES = 30000u;

/// False only where a ray meets none of the sources in the tree.
bool may_meet_in_tree(vec3 origin_ws, vec3 direction_ws) {
    uint at = light_nodes[0].first_child;
    for (uint steps = 0u; at != 0u; ++steps) {
        if (steps == MAX_LIGHT_NODES) return true;
        if (may_meet_group(light_nodes[at], origin_ws, direction_ws)) {
            if (light_nodes[at].children == 0u) return true;
            at = light_nodes[at].first_child;
            continue;
        }
        // to the next sibling, or that of the next ancestor that has one; the root is none's
        while (at != 0u) {
            uint parent = light_nodes[at].parent;
            ++at;
            if (at < light_nodes[parent].first_child + light_nodes[parent].children) break;
            at = parent;
        }
    }
    return false;
}
