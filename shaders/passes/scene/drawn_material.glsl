// The material at a fragment of passes/scene/triangles.vert. Includers that discard fragments before they look
// textures up define DISCARDS_EARLY and call take_footprints() first.
#include "lib/coverage.glsl"
#include "lib/material.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };

uniform sampler2D base_colour_texture;
uniform sampler2D metallic_roughness_texture;
uniform sampler2D normal_texture;
uniform sampler2D emission_texture;
uniform sampler2D transmission_texture;

uniform int material_index;
uniform int normal_maps;  // 0: interpolated vertex normals only
uniform int textures;     // bit i: the i-th of these textures is there

layout(location = 0) in vec3 normal_ws;
layout(location = 1) in vec4 tangent_ws;
layout(location = 2) in vec4 uv01;
layout(location = 3) in vec4 colour;
layout(location = 8) in vec2 base_colour_uv;
layout(location = 9) in vec2 metallic_roughness_uv;
layout(location = 10) in vec2 normal_uv;
layout(location = 11) in vec2 emission_uv;
layout(location = 12) in vec2 transmission_uv;

bool has_texture(int index) { return (textures >> index & 1) != 0; }

/// Derivatives of the coordinates, while all neighbours are there.
vec4 base_colour_footprint = vec4(0), metallic_roughness_footprint = vec4(0), normal_footprint = vec4(0),
     emission_footprint = vec4(0), transmission_footprint = vec4(0);

#ifdef DISCARDS_EARLY
vec4 footprint(vec2 uv) { return vec4(dFdx(uv), dFdy(uv)); }
void take_footprints() {
    base_colour_footprint = footprint(base_colour_uv);
    metallic_roughness_footprint = footprint(metallic_roughness_uv);
    normal_footprint = footprint(normal_uv);
    emission_footprint = footprint(emission_uv);
    transmission_footprint = footprint(transmission_uv);
}
vec4 look_up(sampler2D image, vec2 uv, vec4 f) { return textureGrad(image, uv, f.xy, f.zw); }
#else
vec4 look_up(sampler2D image, vec2 uv, vec4 f) { return texture(image, uv); }
#endif

/// The tangent frame is used as interpolated, neither normalised nor made orthogonal, as bakers assume.
/// [Mikkelsen08; glTF2 §3.7.2.1: bitangent = cross(normal, tangent.xyz) tangent.w]
vec3 mapped_normal(Material material) {
    if (normal_maps == 0 || !has_texture(2)) return normal_ws;
    vec3 n_ts = look_up(normal_texture, normal_uv, normal_footprint).xyz * 2.0 - 1.0;
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
    if (has_texture(0)) result *= look_up(base_colour_texture, base_colour_uv, base_colour_footprint);
    return result;
}

vec2 metallic_roughness(Material material) {
    vec2 result = vec2(material.metallic, material.roughness);
    if (has_texture(1))
        result *= look_up(metallic_roughness_texture, metallic_roughness_uv, metallic_roughness_footprint).bg;
    return result;
}

vec3 emission(Material material) {
    vec3 result = material.emission;
    if (has_texture(3)) result *= look_up(emission_texture, emission_uv, emission_footprint).rgb;
    return result;
}

float transmission(Material material) {
    float result = material.transmission;
    if (has_texture(4)) result *= look_up(transmission_texture, transmission_uv, transmission_footprint).r;
    return result;
}

/// The fraction of the surface that is glass.  [glTF2 KHR_materials_transmission]
float glass_fraction(Material material, float metallic) {
    return (material.flags & MATERIAL_UNLIT) != 0u ? 0.0 : transmission(material) * (1.0 - metallic);
}

/// Whether the surface's alpha mask has a hole here. To be called last, so that all texture look-ups have all
/// neighbours, except after take_footprints().
bool has_hole_here() {
    vec2 mask_uv = uv_of_slot(materials[material_index].base_colour_slot, uv01.xy, uv01.zw);
    return !is_covered(uint(material_index), mask_uv);
}
