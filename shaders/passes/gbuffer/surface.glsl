// The surface at a fragment of passes/gbuffer/gbuffer.vert; renderers/passes/gbuffer/draw_scene.h draws. Includers
// may define SCENE_MOTION.
#include "passes/scene/scene.glsl"
#include "lib/coverage.glsl"
#include "lib/material.glsl"
#include "lib/pixel_rays.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };

uniform sampler2D base_colour_texture;
uniform sampler2D metallic_roughness_texture;
uniform sampler2D normal_texture;
uniform sampler2D emission_texture;
uniform sampler2D transmission_texture;

uniform int material_index;
uniform int normal_maps;  // 0: interpolated vertex normals only
uniform int textures;     // bit i: the texture of unit i is there
uniform vec3 eye_ws;

layout(location = 0) in vec3 normal_ws;
layout(location = 1) in vec4 tangent_ws;
layout(location = 2) in vec4 uv01;
layout(location = 3) in vec4 colour;
layout(location = 4) flat in vec3 plane_normal_ws;
layout(location = 5) flat in vec3 plane_anchor_ws;
layout(location = 6) flat in vec2 depth_range;
layout(location = 7) flat in uint instance;
layout(location = 8) in vec2 base_colour_uv;
layout(location = 9) in vec2 metallic_roughness_uv;
layout(location = 10) in vec2 normal_uv;
layout(location = 11) in vec2 emission_uv;
layout(location = 12) in vec2 transmission_uv;

/// Where the pixel's ray meets the triangle's plane. Edge-on the quotient is ill-conditioned, but never leaves
/// the depths of the corners.
vec3 position_on_plane(vec3 direction) {
    vec3 origin = pixel_ray_origin(gl_FragCoord.xy);
    float depth =
        dot(plane_normal_ws, plane_anchor_ws - origin) / dot(plane_normal_ws, direction);
    return origin + clamp(depth, depth_range.x, depth_range.y) * direction;
}

bool has_texture(int unit) {
    return (textures >> unit & 1) != 0;
}

/// The tangent frame is used as interpolated, neither normalised nor made orthogonal, as bakers assume.
/// [Mikkelsen08; glTF2 §3.7.2.1: bitangent = cross(normal, tangent.xyz) tangent.w]
vec3 mapped_normal(Material material) {
    if (normal_maps == 0 || !has_texture(2)) return normal_ws;
    vec3 n_ts = texture(normal_texture, normal_uv).xyz * 2.0 - 1.0;
    n_ts.xy *= material.normal_scale;
    vec3 bitangent_ws = cross(normal_ws, tangent_ws.xyz) * tangent_ws.w;
    return n_ts.x * tangent_ws.xyz + n_ts.y * bitangent_ws + n_ts.z * normal_ws;
}

/// Turned to the side of the geometric normal by its vertex normal, so that a back face shows the front's
/// relief from behind.
vec3 shading_normal(Material material, vec3 geometric_normal_ws) {
    vec3 n = mapped_normal(material);
    float size = length(n);
    if (size == 0.0) return geometric_normal_ws;
    return n * ((dot(normal_ws, geometric_normal_ws) < 0.0 ? -1.0 : 1.0) / size);
}

vec4 base_colour(Material material) {
    vec4 result = material.base_colour * colour;
    if (has_texture(0)) result *= texture(base_colour_texture, base_colour_uv);
    return result;
}

vec2 metallic_roughness(Material material) {
    vec2 result = vec2(material.metallic, material.roughness);
    if (has_texture(1)) result *= texture(metallic_roughness_texture, metallic_roughness_uv).bg;
    return result;
}

vec3 emission(Material material) {
    vec3 result = material.emission;
    if (has_texture(3)) result *= texture(emission_texture, emission_uv).rgb;
    return result;
}

float transmission(Material material) {
    float result = material.transmission;
    if (has_texture(4)) result *= texture(transmission_texture, transmission_uv).r;
    return result;
}

/// The part of the surface that is glass.  [glTF2 KHR_materials_transmission]
float glass_fraction(Material material, float metallic) {
    return (material.flags & MATERIAL_UNLIT) != 0u ? 0.0 : transmission(material) * (1.0 - metallic);
}

/// What is mostly glass is drawn as what lies behind it, except where it shines.
const float MOSTLY_GLASS = 0.5;
bool is_seen_through(float glass, vec3 emission) { return glass > MOSTLY_GLASS && emission == vec3(0); }

/// To be asked last, so that all texture look-ups have all neighbours.
bool has_hole_here(Material material) {
    vec2 mask_uv = uv_of_slot(material.base_colour_slot, uv01.xy, uv01.zw);
    return !is_covered(uint(material_index), mask_uv);
}
