// Writes what the light sees at the texel's centre.  [Smal19 §5.1]

#include "passes/rsm/texel.glsl"

uniform sampler2D base_colour_texture;
uniform sampler2D metallic_roughness_texture;
uniform sampler2D normal_texture;
uniform sampler2D transmission_texture;
#ifdef DEPTH_PREPASS
uniform sampler2DArray depth_drawn_first;
uniform int layer;

/// Two programs may round one depth to different floats. What lies behind by less is left to the depth test.
const float ROUNDING = 1e-6;
#endif

uniform int normal_maps;  // 0: interpolated vertex normals only
uniform int opaque_only;  // 1: transmission is ignored
uniform int textures;     // bit i: the texture of unit i is there

layout(location = 0) in vec3 normal_ws;
layout(location = 1) in vec4 tangent_ws;
layout(location = 3) in vec4 colour;
layout(location = 7) in vec2 base_colour_uv;
layout(location = 8) in vec2 metallic_roughness_uv;
layout(location = 9) in vec2 normal_uv;
layout(location = 10) in vec2 transmission_uv;

layout(location = 0) out vec4 albedo_roughness;
layout(location = 1) out vec4 normal_metalness;
#ifdef GEOMETRIC_NORMAL
layout(location = 2) out vec4 triangle_normal;
#endif

/// Derivatives were taken before fragments behind others left.
struct Footprint {
    vec2 dx, dy;
};
Footprint footprint(vec2 uv) { return Footprint(dFdx(uv), dFdy(uv)); }

bool has_texture(int unit) { return (textures >> unit & 1) != 0; }

/// The tangent frame is used as interpolated, neither normalised nor made orthogonal, as bakers assume.
/// [Mikkelsen08; glTF2 §3.7.2.1]
vec3 mapped_normal(Material material, Footprint f) {
    if (normal_maps == 0 || !has_texture(2)) return normal_ws;
    vec3 n_ts = textureGrad(normal_texture, normal_uv, f.dx, f.dy).xyz * 2.0 - 1.0;
    n_ts.xy *= material.normal_scale;
    vec3 bitangent_ws = cross(normal_ws, tangent_ws.xyz) * tangent_ws.w;
    return n_ts.x * tangent_ws.xyz + n_ts.y * bitangent_ws + n_ts.z * normal_ws;
}

/// On the side of the light, by the vertex normal, as the G-buffer turns it to the viewer.
vec3 shading_normal(vec3 mapped_ws, vec3 geometric_normal_ws) {
    float size = length(mapped_ws);
    if (size == 0.0) return geometric_normal_ws;
    return mapped_ws * ((dot(normal_ws, geometric_normal_ws) < 0.0 ? -1.0 : 1.0) / size);
}

void main() {
    Footprint colour_footprint = footprint(base_colour_uv), material_footprint = footprint(metallic_roughness_uv);
    Footprint normal_footprint = footprint(normal_uv), glass_footprint = footprint(transmission_uv);
    float depth = texel_depth();
#ifdef DEPTH_PREPASS
    if (depth > texelFetch(depth_drawn_first, ivec3(gl_FragCoord.xy, layer), 0).r + ROUNDING) discard;
#endif
    if (!texel_is_covered()) discard;
    gl_FragDepth = depth;

    Material material = materials[material_index];
    vec3 base_colour = material.base_colour.rgb * colour.rgb;
    if (has_texture(0))
        base_colour *= textureGrad(base_colour_texture, base_colour_uv, colour_footprint.dx, colour_footprint.dy).rgb;
    vec2 metallic_roughness = vec2(material.metallic, material.roughness);
    if (has_texture(1))
        metallic_roughness *= textureGrad(metallic_roughness_texture, metallic_roughness_uv, material_footprint.dx,
                                          material_footprint.dy).bg;
    float glass = material.transmission;
    if (has_texture(3))
        glass *= textureGrad(transmission_texture, transmission_uv, glass_footprint.dx, glass_footprint.dy).r;
    bool scatters = (material.flags & MATERIAL_UNLIT) == 0u && (opaque_only != 0 || glass <= 0.5);

    vec3 geometric_normal_ws =
        dot(plane_normal_ws, texel_direction()) > 0.0 ? -plane_normal_ws : plane_normal_ws;
#ifdef GEOMETRIC_NORMAL
    triangle_normal = vec4(geometric_normal_ws, 0.0);
#endif
    albedo_roughness = vec4(base_colour, metallic_roughness.y);
    normal_metalness = vec4(shading_normal(mapped_normal(material, normal_footprint), geometric_normal_ws),
                            (scatters ? 1.0 : -1.0) * (1.0 + clamp(metallic_roughness.x, 0.0, 1.0)));
}
