// What the sources send, and with what density sample_source() at a point would have chosen what a ray from there met.
// `normal_ws`: the point's unit geometric normal.
#include "passes/lights/environment_light.glsl"
#include "passes/lights/lamps.glsl"
#include "passes/lights/light_tree.glsl"
#include "passes/lights/triangle_lights.glsl"

bool has_environment(SourceTotals sources) { return sources.environment_weight > 0.0; }

/// Between what has a place and the environment.
float share_of(SourceTotals sources, float weight) {
    float sum = sources.tree_weight + sources.environment_weight;
    return sum > 0.0 ? weight / sum : 0.0;
}

float pdf_of_triangle(SourceTotals sources, vec3 position_ws, vec3 normal_ws, EmissiveTriangle t, vec2 at) {
    return probability_in_tree(position_ws, normal_ws, t.node) * share_of(sources, sources.tree_weight) *
           pdf_on_triangle(t, position_ws, at);
}
float pdf_of_lamp(SourceTotals sources, vec3 position_ws, vec3 normal_ws, LampData lamp, vec3 direction_ws) {
    float distance = lamp_distance(lamp, position_ws, direction_ws);
    if (!(distance < NOT_MET) || !(lamp.area > 0.0)) return 0.0;
    return probability_in_tree(position_ws, normal_ws, lamp.node) * share_of(sources, sources.tree_weight) *
           pdf_of_lamp(lamp, seen_lamp(lamp, position_ws), distance);
}
float pdf_of_environment(SourceTotals sources, vec3 normal_ws, vec3 direction_ws) {
    return share_of(sources, sources.environment_weight) * pdf_of_sky(sources, normal_ws, direction_ws);
}
