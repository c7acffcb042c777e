// What a surfel sends to all directions of one side alike. EMITS: emission counts. MATERIALS: as Transport::Materials
// counts.
#include "passes/scene/hit_surface.glsl"
#include "lib/brdf.glsl"
#include "passes/shadow/shadow.glsl"
#include "methods/deep-screen-space/surfels/diffuse.glsl"

layout(std430) readonly buffer Lights { Light lights[]; };

uniform int light_count, normal_maps;
uniform float light_offset;  // radii

vec3 reflected(HitSurface s, vec3 position_ws, float radius) {
    vec3 albedo = diffuse_albedo(s), sum = vec3(0);
    if (albedo == vec3(0)) return sum;
    for (int i = 0; i < light_count; ++i) {
        if (!is_punctual(lights[i])) continue;
        PunctualArrival light = punctual_arrival(lights[i], position_ws);
        float cosine = dot(s.shading_normal_ws, light.direction_ws);
        if (cosine <= 0.0 || dot(s.geometric_normal_ws, light.direction_ws) <= 0.0 || light.irradiance == vec3(0))
            continue;
        float visible = shadow_visibility(lights[i], position_ws + light_offset * radius * s.geometric_normal_ws,
                                          s.geometric_normal_ws, light.direction_ws, 0);
        sum += below_interface(s, light.direction_ws) * light.irradiance * (cosine * visible);
    }
    return albedo / PI * sum;
}

#if EMITS
vec3 emitted(uint triangle, vec2 weights) {
    Material m = hit_materials[hit_triangle_materials[triangle]];
    if (m.emission_slot.texture < 0 || m.emission == vec3(0)) return m.emission;
    HitCorners c;
    c.first = 4u * uvec3(hit_indices[3u * triangle], hit_indices[3u * triangle + 1u], hit_indices[3u * triangle + 2u]);
    c.weights = vec3(1.0 - weights.x - weights.y, weights);
    vec4 uv = hit_mix(c, 3u);
    return m.emission * texture_at(m.emission_slot.texture, uv_of_slot(m.emission_slot, uv.xy, uv.zw)).rgb;
}
#endif
