// Reading an RSM, as renderers/passes/rsm/rsm.h draws it: what a texel shows, and how
// much light goes there.

// The RSM's depth has the form of shadow maps.
#include "passes/shadow/shadow.glsl"
#include "passes/rsm/opacity.glsl"
#include "methods/photon-mapping/survival.glsl"

layout(std430) readonly buffer Lights { Light lights[]; };
uniform sampler2DArray rsm_albedo_roughness;
uniform sampler2DArray rsm_normal_metalness;
uniform sampler2DArray rsm_geometric_normal;

uniform int materials_model;       // one of survival.glsl's
uniform bool follows_mirrors;
uniform float photon_near, photon_far;  // m; 0 as far plane: none

struct RsmTexel {
    vec3 position_ws;
    vec3 normal_ws;    // shading normal, unit, on the light's side
    vec3 geometric_normal_ws;
    vec3 base_colour;
    float metalness, roughness;
    float ior;         // of what is all opaque
    bool is_met_again; // by photons, along their ray
    bool scatters;
    float distance;    // m from the light, or from the near plane of a directional light's map
    float part;        // of the light's intensity that arrives: spot's profile and window at its range
    float extent;      // sr that the texel spans; m² for a directional light
    float extent_part; // that over the same of the map's middle
};

/// From the light through a place of the map, in texels; the direction advances by 1 along the map's axis.
struct RsmRay {
    vec3 origin_ws, direction_ws;
};
RsmRay rsm_ray(vec2 place, ShadowView view) {
    vec2 ndc = (place / float(textureSize(shadow_maps, 0).x) * 2.0 - 1.0) * vec2(1, -1);
    vec3 lateral_ws = ndc.x * view.right_ws + ndc.y * view.up_ws;
    return view.perspective != 0.0 ? RsmRay(view.origin_ws, view.forward_ws + lateral_ws)
                                   : RsmRay(view.origin_ws + lateral_ws, view.forward_ws);
}

/// Along the map's axis, m.
float rsm_depth(ivec2 texel, int layer) {
    return texelFetch(shadow_maps, ivec3(texel, layer), 0).r * shadow_views[layer].far;
}

/// Of the normals' fourth components: something is there that light changes.
bool scatters(float metalness, float opacity) {
    return metalness > 0.0 || (metalness < 0.0 && opacity < 1.0);  // no glass: unlit
}

RsmTexel rsm_texel(ivec2 texel, int layer) {
    ShadowView view = shadow_views[layer];
    int resolution = textureSize(shadow_maps, 0).x;
    bool perspective = view.perspective != 0.0;
    RsmRay ray = rsm_ray(vec2(texel) + 0.5, view);
    vec3 direction_ws = ray.direction_ws;
    float depth = rsm_depth(texel, layer);
    vec4 albedo = texelFetch(rsm_albedo_roughness, ivec3(texel, layer), 0);
    vec4 normal = texelFetch(rsm_normal_metalness, ivec3(texel, layer), 0);
    vec4 plane = texelFetch(rsm_geometric_normal, ivec3(texel, layer), 0);

    RsmTexel t;
    t.position_ws = ray.origin_ws + depth * direction_ws;
    t.scatters = scatters(normal.w, plane.w);
    t.normal_ws = t.scatters ? normalize(normal.xyz) : vec3(0, 1, 0);
    t.metalness = clamp(abs(normal.w) - 1.0, 0.0, 1.0);
    t.geometric_normal_ws = t.scatters ? plane.xyz : t.normal_ws;
    t.base_colour = albedo.rgb;
    t.roughness = albedo.a;
    t.ior = plane.w < OPAQUE_INDEX ? 1.5 : plane.w - OPAQUE_INDEX;
    t.is_met_again =
        t.scatters && is_met_again(plane.w, t.metalness, t.roughness, materials_model, follows_mirrors);
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

/// Whether the surface of a texel goes on in the plane of another.
bool is_in_plane(RsmTexel t, ivec2 texel, int layer) {
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, textureSize(shadow_maps, 0).xy))) return false;
    ivec3 place = ivec3(texel, layer);
    if (!scatters(texelFetch(rsm_normal_metalness, place, 0).w, texelFetch(rsm_geometric_normal, place, 0).w))
        return false;
    RsmRay ray = rsm_ray(vec2(texel) + 0.5, shadow_views[layer]);
    vec3 offset = ray.origin_ws + rsm_depth(texel, layer) * ray.direction_ws - t.position_ws;
    // a thousandth of the step, as maps' normals and depths are rounded
    return abs(dot(t.geometric_normal_ws, offset)) < 1e-3 * length(offset);
}

/// A place on the plane of the surface that a texel shows, by `within` in [0, 1)². Towards neighbours that show
/// another surface the place stays in the texel's middle: the plane may end there, or lie behind a wall.
vec3 jittered_position(RsmTexel t, vec2 within, ivec2 texel, int layer) {
    ivec2 side = ivec2(within.x < 0.5 ? -1 : 1, within.y < 0.5 ? -1 : 1);
    bvec2 goes_on = bvec2(is_in_plane(t, texel + ivec2(side.x, 0), layer),
                          is_in_plane(t, texel + ivec2(0, side.y), layer));
    if (all(goes_on) && !is_in_plane(t, texel + side, layer)) goes_on.y = false;
    RsmRay ray = rsm_ray(vec2(texel) + mix(vec2(0.5), within, goes_on), shadow_views[layer]);
    float fall = dot(t.geometric_normal_ws, ray.direction_ws);
    if (fall > -1e-4 * length(ray.direction_ws)) return t.position_ws;
    return ray.origin_ws + dot(t.geometric_normal_ws, t.position_ws - ray.origin_ws) / fall * ray.direction_ws;
}

/// Probability of the roulette before a photon leaves; 0 where none does.
float rsm_survival(RsmTexel t) {
    if (!t.scatters || t.part <= 0.0 || !is_between_planes(t.distance)) return 0.0;
    if (t.is_met_again) return 1.0;  // the roulette is that of the scattering
    return survival_probability(first_reflectance(t.base_colour, t.metalness, t.ior, materials_model));
}
