// Reading an RSM, as renderers/passes/rsm/rsm.h draws it: what a texel shows, and how
// much light goes there.

// The RSM's depth has the form of shadow maps.
#include "passes/shadow/shadow.glsl"
#include "methods/photon-mapping/survival.glsl"

layout(std430) readonly buffer Lights { Light lights[]; };
uniform sampler2DArray rsm_albedo_roughness;
uniform sampler2DArray rsm_normal_metalness;

uniform int materials_model;       // one of survival.glsl's
uniform float photon_near, photon_far;  // m; 0 as far plane: none

struct RsmTexel {
    vec3 position_ws;
    vec3 normal_ws;    // unit, on the light's side
    vec3 base_colour;
    float metalness, roughness;
    bool scatters;     // something opaque is there
    float distance;    // m from the light, or from the near plane of a directional light's map
    float part;        // of the light's intensity that arrives: spot's profile and window at its range
    float extent;      // sr that the texel spans; m² for a directional light
    float extent_part; // that over the same of the map's middle
};

RsmTexel rsm_texel(ivec2 texel, int layer) {
    ShadowView view = shadow_views[layer];
    int resolution = textureSize(shadow_maps, 0).x;
    vec2 ndc = ((vec2(texel) + 0.5) / float(resolution) * 2.0 - 1.0) * vec2(1, -1);
    vec3 lateral_ws = ndc.x * view.right_ws + ndc.y * view.up_ws;
    bool perspective = view.perspective != 0.0;
    vec3 origin_ws = perspective ? view.origin_ws : view.origin_ws + lateral_ws;
    vec3 direction_ws = perspective ? view.forward_ws + lateral_ws : view.forward_ws;
    float depth = texelFetch(shadow_maps, ivec3(texel, layer), 0).r * view.far;
    vec4 albedo = texelFetch(rsm_albedo_roughness, ivec3(texel, layer), 0);
    vec4 normal = texelFetch(rsm_normal_metalness, ivec3(texel, layer), 0);

    RsmTexel t;
    t.position_ws = origin_ws + depth * direction_ws;
    t.scatters = normal.w > 0.0;
    t.normal_ws = t.scatters ? normalize(normal.xyz) : vec3(0, 1, 0);
    t.metalness = clamp(abs(normal.w) - 1.0, 0.0, 1.0);
    t.base_colour = albedo.rgb;
    t.roughness = albedo.a;
    float size = length(direction_ws);
    t.distance = depth * size;
    Light light = lights[view.light];
    t.part = range_window(light.range, perspective ? t.distance : 0.0);
    t.part *= spot_fraction(light, dot(direction_ws, light.direction_ws) / size);
    // dω = dA cosθ / d² on the plane at distance 1
    t.extent_part = perspective ? 1.0 / (size * size * size) : 1.0;
    t.extent = 4.0 * length(view.right_ws) * length(view.up_ws) / float(resolution * resolution) * t.extent_part;
    return t;
}

bool is_between_planes(float distance) {
    return distance >= photon_near && (photon_far <= 0.0 || distance <= photon_far);
}

vec3 rsm_reflectance(RsmTexel t) {
    return first_reflectance(t.base_colour, t.metalness, t.roughness, materials_model);
}

/// Probability of the roulette before a photon leaves; 0 where none does.
float rsm_survival(RsmTexel t) {
    if (!t.scatters || t.part <= 0.0 || !is_between_planes(t.distance)) return 0.0;
    return survival_probability(rsm_reflectance(t));
}
