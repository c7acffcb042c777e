// The surface that a ray hit, as passes::SurfaceLookup finds it on the host: the same quantities as the
// G-buffer's, from textures at their finest level (renderers/passes/scene/hit_surfaces.h).
#include "passes/scene/hit_materials.glsl"
#include "passes/scene/hit_triangle.glsl"
#include "passes/scene/texels.glsl"

struct HitSurface {
    vec3 position_ws;
    vec3 geometric_normal_ws;  // unit, on the side that the ray came from
    vec3 shading_normal_ws;    // unit, turned as the G-buffer turns it
    vec3 base_colour;
    float metallic, roughness, ior, transmission;
    uint material;
    bool is_front;  // the ray came from the side to which the winding's normal points
    bool is_unlit;
};

struct HitCorners {
    uvec3 first;   // of the vec4 of each corner
    vec3 weights;
};

vec4 hit_mix(HitCorners c, uint part) {
    return c.weights.x * hit_vertices[c.first.x + part] + c.weights.y * hit_vertices[c.first.y + part] +
           c.weights.z * hit_vertices[c.first.z + part];
}

vec3 hit_colour(HitCorners c) {
    return c.weights.x * unpackUnorm4x8(floatBitsToUint(hit_vertices[c.first.x].w)).rgb +
           c.weights.y * unpackUnorm4x8(floatBitsToUint(hit_vertices[c.first.y].w)).rgb +
           c.weights.z * unpackUnorm4x8(floatBitsToUint(hit_vertices[c.first.z].w)).rgb;
}

/// To the side of the geometric normal by its vertex normal.
vec3 hit_turned(vec3 n, vec3 vertex_normal_ws, vec3 geometric_normal_ws) {
    float size = length(n);
    if (!(size > 0.0)) return geometric_normal_ws;
    return n * ((dot(vertex_normal_ws, geometric_normal_ws) < 0.0 ? -1.0 : 1.0) / size);
}

/// The tangent frame is used as interpolated, neither normalised nor made orthogonal, as bakers assume.
/// [Mikkelsen08; glTF2 §3.7.2.1]
vec3 hit_mapped_normal(Material m, HitCorners c, vec4 uv, vec3 normal_ws) {
    vec3 n_ts = 2.0 * texture_at(m.normal_slot.texture, uv_of_slot(m.normal_slot, uv.xy, uv.zw)) - 1.0;
    n_ts.xy *= m.normal_scale;
    vec4 tangent = hit_mix(c, 2u);
    vec3 bitangent_ws = cross(normal_ws, tangent.xyz) * tangent.w;
    return n_ts.x * tangent.xyz + n_ts.y * bitangent_ws + n_ts.z * normal_ws;
}

/// `u` and `v`: barycentric weights of the triangle's second and third corner; `direction_ws` of travel.
HitSurface hit_surface(uint triangle, float u, float v, vec3 direction_ws, bool normal_maps) {
    HitCorners c;
    c.first = hit_corners(triangle);
    c.weights = vec3(1.0 - u - v, u, v);
    vec3 pa = hit_vertices[c.first.x].xyz, pb = hit_vertices[c.first.y].xyz, pc = hit_vertices[c.first.z].xyz;

    HitSurface s;
    s.position_ws = pa + u * (pb - pa) + v * (pc - pa);
    vec3 plane_normal_ws = triangle_plane(pa, pb, pc).normal;
    s.is_front = dot(plane_normal_ws, direction_ws) <= 0.0;
    s.geometric_normal_ws = s.is_front ? plane_normal_ws : -plane_normal_ws;
    if (plane_normal_ws == vec3(0)) s.geometric_normal_ws = -direction_ws;

    s.material = hit_triangle_materials[triangle];
    Material m = hit_materials[s.material];
    s.base_colour = m.base_colour.rgb * hit_colour(c);
    s.metallic = m.metallic;
    s.roughness = m.roughness;
    s.ior = m.ior;
    s.transmission = m.transmission;
    s.is_unlit = (m.flags & MATERIAL_UNLIT) != 0u;

    vec3 vertex_normal_ws = hit_mix(c, 1u).xyz;
    vec3 normal_ws = vertex_normal_ws;
    vec4 uv = hit_mix(c, 3u);
    if (m.base_colour_slot.texture >= 0)
        s.base_colour *=
            texture_at(m.base_colour_slot.texture, uv_of_slot(m.base_colour_slot, uv.xy, uv.zw));
    if (m.metallic_roughness_slot.texture >= 0) {
        vec3 texel = texture_at(m.metallic_roughness_slot.texture,
                                uv_of_slot(m.metallic_roughness_slot, uv.xy, uv.zw));
        s.metallic *= texel.b;
        s.roughness *= texel.g;
    }
    if (m.transmission_slot.texture >= 0)
        s.transmission *=
            texture_at(m.transmission_slot.texture, uv_of_slot(m.transmission_slot, uv.xy, uv.zw)).r;
    if (normal_maps && m.normal_slot.texture >= 0) normal_ws = hit_mapped_normal(m, c, uv, vertex_normal_ws);
    s.shading_normal_ws = hit_turned(normal_ws, vertex_normal_ws, s.geometric_normal_ws);
    return s;
}
