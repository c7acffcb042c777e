// The surface that a pixel shows.
#include "passes/direct/device/samples.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_material;

uniform vec3 eye_ws;
uniform vec3 view_axis_ws;  // of an orthographic view; 0 for a perspective one

SeenSurface seen_surface(ivec2 pixel) {
    SeenSurface seen;
    vec4 position = texelFetch(gbuffer_position, pixel, 0), material = texelFetch(gbuffer_material, pixel, 0);
    seen.exists = position.w != 0.0 && material.z <= 0.5;
    if (!seen.exists) return seen;
    vec4 albedo = texelFetch(gbuffer_albedo, pixel, 0);
    vec3 normal = texelFetch(gbuffer_normal, pixel, 0).xyz;
    seen.position_ws = position.xyz;
    seen.wo = view_axis_ws == vec3(0) ? normalize(eye_ws - seen.position_ws) : -view_axis_ws;
    seen.geometric_n = with_sign_of_zero(normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz));
    float size = length(normal);  // half floats: not quite 1
    vec3 n = size > 0.5 ? with_sign_of_zero(normal / size) : seen.geometric_n;
    // a half float, which is exact only up to 2048
    Material m = materials[uint(clamp(material.w + 0.5, 0.0, float(materials.length() - 1)))];
    seen.scatterer = make_scatterer(n, seen.geometric_n, albedo.rgb, material.x, material.y, m.ior, MATERIALS);
    seen.glass = NO_GLASS;
    if (MATERIALS != SCATTERING_LAMBERT)
        seen.glass = make_glass(albedo.a * (1.0 - material.x), m.ior, m.thickness, albedo.rgb, true);
    return seen;
}
