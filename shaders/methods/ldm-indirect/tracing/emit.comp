// A photon for each pixel of the lights' images, with its differential at the first surface.
// [Aalund15 §4.2; Igehy99]
layout(local_size_x = 64) in;
#include "passes/shadow/shadow.glsl"
#include "passes/ldm/frames.glsl"
#include "lib/brdf.glsl"
#include "lib/spaces.glsl"
#include "methods/ldm-indirect/tracing/differentials.glsl"
#include "methods/ldm-indirect/tracing/primary.glsl"

layout(std430) readonly buffer Lights { Light lights[]; };
layout(std430) writeonly buffer Primaries { Primary primaries[]; };
uniform sampler2DArray rsm_albedo_roughness;
uniform sampler2DArray rsm_normal_metalness;
uniform sampler2DArray rsm_geometric_normal;

uniform uint first_item, end_item;
uniform uint views_drawn, map_count;

/// Mesa's atan is wrong by 2e-5 near 0.
float small_arc_tangent(float y, float x) {
    float t = y / x, s = t * t;
    if (x <= 0.0 || t > 0.25) return atan(y, x);
    return t * (1.0 - s * (1.0 / 3.0 - s * (1.0 / 5.0 - s * (1.0 / 7.0 - s / 9.0))));
}

/// Solid angle of a triangle at height 1 above the origin, `volume` twice its area: without the cancellation of
/// differences of arc tangents at a rectangle's corners, which costs small pixels 3 digits. [VanOosterom83]
float triangle_solid_angle(vec3 a, vec3 b, vec3 c, float volume) {
    float la = length(a), lb = length(b), lc = length(c);
    return 2.0 * small_arc_tangent(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// Of a pixel of a perspective image whose sides are 2 `extent` long at distance 1.
float pixel_solid_angle(vec2 pixel, vec2 extent, float side) {
    vec2 low = (2.0 * pixel / side - 1.0) * extent, high = (2.0 * (pixel + 1.0) / side - 1.0) * extent;
    vec2 size = 2.0 * extent / side;
    vec3 a = vec3(low, 1), b = vec3(high.x, low.y, 1), c = vec3(high, 1), d = vec3(low.x, high.y, 1);
    return triangle_solid_angle(a, b, c, size.x * size.y) + triangle_solid_angle(a, c, d, size.x * size.y);
}

Primary emitted_photon(uint source, ivec2 texel, int layer, float side) {
    ShadowView view = shadow_views[layer];
    Light light = lights[view.light];
    bool perspective = view.perspective != 0.0;
    vec2 ndc = ((vec2(texel) + 0.5) / side * 2.0 - 1.0) * vec2(1, -1);
    vec3 lateral_ws = ndc.x * view.right_ws + ndc.y * view.up_ws;
    vec3 step_u = 2.0 / side * view.right_ws, step_v = -2.0 / side * view.up_ws;
    vec3 towards = perspective ? view.forward_ws + lateral_ws : view.forward_ws;
    float size = length(towards);
    vec2 extent = vec2(length(view.right_ws), length(view.up_ws));

    Primary p;
    p.source = source;
    p.light = uint(view.light);
    p.position_ws = perspective ? view.origin_ws : view.origin_ws + lateral_ws;
    p.direction_ws = towards / size;
    p.axis_u = perspective ? vec3(0) : 0.5 * step_u;
    p.axis_v = perspective ? vec3(0) : 0.5 * step_v;
    p.turn_u = perspective ? 0.5 * normalised_change(towards, step_u) : vec3(0);
    p.turn_v = perspective ? 0.5 * normalised_change(towards, step_v) : vec3(0);
    p.solid_angle = perspective ? pixel_solid_angle(vec2(texel), extent, side)
                                : 4.0 * extent.x * extent.y / (side * side);
    p.emitted = light.intensity * p.solid_angle;
    p.emitted *= spot_fraction(light, dot(p.direction_ws, light.direction_ws));
    p.path_length = texelFetch(shadow_maps, ivec3(texel, layer), 0).r * view.far * size;
    p.reached = range_window(light.range, perspective ? p.path_length : 0.0);
    p.fate = PRIMARY_NOTHING;
    p.cosine_sum = 1.0;
    p.normal_ws = p.shading_ws = -p.direction_ws;
    p.reflectance = vec3(0);
    p.missed = p.unused0 = p.unused1 = 0.0;
    return p;
}

/// Σ|cosθ|: of each map's two directions one is above the surface. [Aalund15 eq. 2]
float cosines(vec3 normal) {
    float sum = 0.0;
    for (uint map = 0u; map < map_count; ++map) sum += abs(dot(normal, ldm_frames[map].direction.xyz));
    return sum;
}

/// Of dielectrics: what lights see knows no index of refraction, and 1.5 is usual.
// C++: ir::methods::ldm_indirect::usual_f0
const float USUAL_F0 = 0.04;
/// Between a surface and its light: at grazing angles the fit of directional_albedo() is wrong.
// C++: ir::methods::ldm_indirect::min_sender_cosine
const float MIN_SENDER_COSINE = 0.05;

/// All surfaces send as Lambertian ones; unlit ones and glass send nothing.
/// DEVIATION [glTF2 B.3]: with the whole albedo what the interface reflects goes into all directions, too.
vec3 sent_part(vec3 base_colour, float roughness, float tag, float cosine) {
    if (tag <= 0.0) return vec3(0);
    if (params.materials == MATERIALS_LAMBERT) return base_colour;
    float metallic = tag - 1.0;
    vec3 diffuse = (1.0 - metallic) * base_colour;
    if (params.senders == SENDERS_DIFFUSE) return diffuse;
    float bounded = max(cosine, MIN_SENDER_COSINE);
    if (params.materials == MATERIALS_METALNESS_BLEND)
        return diffuse + metallic * directional_albedo(base_colour, roughness, bounded);
    vec3 interface_albedo = directional_albedo(mix(vec3(USUAL_F0), base_colour, metallic), roughness, bounded);
    return (1.0 - interface_albedo) * diffuse + interface_albedo;
}

void arrive(inout Primary p, ivec2 texel, int layer) {
    vec4 shading = texelFetch(rsm_normal_metalness, ivec3(texel, layer), 0);
    if (shading.w == 0.0 || p.emitted == vec3(0)) return;  // nothing there, or beside a spot light's cone
    p.fate = PRIMARY_SPLITS;
    p.normal_ws = texelFetch(rsm_geometric_normal, ivec3(texel, layer), 0).xyz;
    p.shading_ws = normalize(shading.xyz);
    vec4 albedo = texelFetch(rsm_albedo_roughness, ivec3(texel, layer), 0);
    p.reflectance = sent_part(albedo.rgb, albedo.a, shading.w, -dot(p.direction_ws, p.shading_ws));
    p.position_ws += p.path_length * p.direction_ws;
    p.cosine_sum = max(cosines(p.shading_ws), 1e-20);
    if (dot(p.direction_ws, p.normal_ws) > -MIN_FACING) {
        p.fate = PRIMARY_DEGENERATE;
        p.axis_u = p.axis_v = vec3(0);
        return;
    }
    p.axis_u = transferred(p.axis_u, p.turn_u, p.path_length, p.direction_ws, p.normal_ws);
    p.axis_v = transferred(p.axis_v, p.turn_v, p.path_length, p.direction_ws, p.normal_ws);
}

void main() {
    uint source = first_item + gl_GlobalInvocationID.x;
    if (source >= end_item) return;
    uint side = uint(textureSize(shadow_maps, 0).x);
    int layer = int(source / (side * side));
    uint place = source % (side * side);
    ivec2 texel = ivec2(place % side, place / side);
    Primary p;
    if (uint(layer) < views_drawn) {
        p = emitted_photon(source, texel, layer, float(side));
        arrive(p, texel, layer);
    } else {
        p = Primary(vec3(0), source, vec3(0), 0u, vec3(0), 0.0, vec3(0), 1.0, vec3(0), PRIMARY_NOTHING,
                    vec3(0, 0, 1), 1.0, vec3(0, 0, -1), 0.0, vec3(0, 0, -1), 0.0, vec3(0), 0.0, vec3(0), 0.0);
    }
    primaries[source] = p;
}
