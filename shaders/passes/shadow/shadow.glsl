// Looking up "shadow.maps".

#include "lib/light.glsl"

/// One layer of "shadow.maps". The point at x, y in normalised device coordinates and t metres along the axis is
/// origin + t forward + s (x right + y up), s = t for a perspective and 1 for an orthographic map. Maps hold
/// t / far.
// C++: ir::passes::ShadowViewData
struct ShadowView {
    mat4 clip_from_world;
    vec3 origin_ws;
    float perspective;  // 1 or 0
    vec3 right_ws;
    float far;          // m
    vec3 up_ws;
    int light;          // index into World::lights
    vec3 forward_ws;
    float near;         // m
};
layout(std430) readonly buffer ShadowViews { ShadowView shadow_views[]; };
uniform sampler2DArray shadow_maps;
/// Fraction of the light that comes through sheets of clear glass to what the map holds.
uniform sampler2DArray shadow_panes;

/// The receiver is lifted along its normal by this many texels times the sine of the light's angle, which
/// covers what its tangent plane misses of curved and folded surfaces.  [Holbert11, normal offset]
/// Against rays, 0 shadows up to 7 % of Sponza's lit pixels and 0.5 lights up to 2.6 % of all falsely; in between
/// both stay below 2 % at 1024 texels.
// C++: ir::passes::shadow_normal_offset
const float NORMAL_OFFSET = 0.3;
/// Slope beyond which the receiver's plane is not followed within a texel.  [King04, slope-scaled bias]
// C++: ir::passes::shadow_steepest_slope
const float STEEPEST_SLOPE = 16.0;
/// Rounding of depths and positions, as a part of the map's far distance.
// C++: ir::passes::shadow_rounding
const float ROUNDING = 4e-6;

/// The layer that sees a point: lights with a cube of maps choose by the largest component.
int shadow_layer_of(Light light, vec3 position_ws) {
    if (light.shadow_layers != 6) return light.shadow_layer;
    vec3 offset = position_ws - light.position_ws, size = abs(offset);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return light.shadow_layer + 2 * axis + (offset[axis] < 0.0 ? 1 : 0);
}

/// Depth along the map's axis at which the ray through a texel's centre meets the receiver's tangent plane,
/// near `depth`: what the map holds there if nothing blocks.  [Isidoro06, receiver plane depth bias]
float receiver_depth(ShadowView view, vec2 ndc, vec3 position_ws, vec3 normal_ws, float depth, float limit) {
    vec3 lateral = ndc.x * view.right_ws + ndc.y * view.up_ws;
    bool perspective = view.perspective != 0.0;
    vec3 origin = perspective ? view.origin_ws : view.origin_ws + lateral;
    vec3 direction = perspective ? view.forward_ws + lateral : view.forward_ws;
    float slope = dot(normal_ws, direction);
    if (slope >= 0.0) return depth - limit;
    return clamp(dot(normal_ws, position_ws - origin) / slope, depth - limit, depth + limit);
}

/// Fraction of the light that comes to a point: of (2 radius + 1)² texels about it those from which the light is seen,
/// 1 without a map, times what sheets of glass before it let pass.
/// `normal_ws` is the geometric normal, turned to the light, `to_light_ws` of unit length.
vec3 shadow_visibility(Light light, vec3 position_ws, vec3 normal_ws, vec3 to_light_ws, int radius) {
    if (light.shadow_layers == 0) return vec3(1);
    int layer = shadow_layer_of(light, position_ws);
    ShadowView view = shadow_views[layer];
    int resolution = textureSize(shadow_maps, 0).x;
    bool perspective = view.perspective != 0.0;

    float cosine = clamp(dot(normal_ws, to_light_ws), 0.0, 1.0);
    float sine = sqrt(1.0 - cosine * cosine);
    float reach = perspective ? dot(position_ws - view.origin_ws, view.forward_ws) : 1.0;
    float texel_m = 2.0 * max(length(view.right_ws), length(view.up_ws)) * reach / float(resolution);
    vec3 receiver_ws = position_ws + NORMAL_OFFSET * texel_m * sine * normal_ws;

    vec3 offset = receiver_ws - view.origin_ws;
    float depth = dot(offset, view.forward_ws);
    float scale = perspective ? 1.0 / depth : 1.0;
    vec2 ndc = scale * vec2(dot(offset, view.right_ws) / dot(view.right_ws, view.right_ws),
                            dot(offset, view.up_ws) / dot(view.up_ws, view.up_ws));
    vec2 place = ndc * vec2(0.5, -0.5) + 0.5;
    ivec2 centre = ivec2(floor(place * float(resolution)));
    float limit = STEEPEST_SLOPE * (float(radius) + 1.0) * texel_m;

    float lit = 0.0;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            ivec2 texel = clamp(centre + ivec2(x, y), ivec2(0), ivec2(resolution - 1));
            vec2 texel_ndc = ((vec2(texel) + 0.5) / float(resolution) * 2.0 - 1.0) * vec2(1, -1);
            float expected = receiver_depth(view, texel_ndc, receiver_ws, normal_ws, depth, limit);
            float stored = texelFetch(shadow_maps, ivec3(texel, layer), 0).r * view.far;
            if (stored >= expected - ROUNDING * view.far) lit += 1.0;
        }
    }
    float width = float(2 * radius + 1);
    ivec2 panes = textureSize(shadow_panes, 0).xy;
    vec3 passed = texelFetch(shadow_panes, ivec3(clamp(ivec2(place * vec2(panes)), ivec2(0), panes - 1), layer), 0).rgb;
    return lit / (width * width) * passed;
}
