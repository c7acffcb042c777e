// Which rays glass lets through. It is decided by chance, so that what is met is one sender all the same: the light
// is right on average, as that of rays that split is. Where GLASS is 1 include passes/scene/hit_materials.glsl
// before it. [Nalbach15 §6; Wyman17]
#include "lib/brdf.glsl"
#include "lib/luminance.glsl"
#include "lib/material.glsl"
#include "lib/random.glsl"

#if GLASS
/// Part of a surface that is glass. Where a texture says which part is, and where it shines, none.
float open_glass(Material m) {
    bool is_open = (m.flags & MATERIAL_UNLIT) == 0u && m.transmission_slot.texture < 0 && m.emission == vec3(0);
    return is_open ? m.transmission * (1.0 - m.metallic) : 0.0;
}

/// Part of the light along a ray with this cosine to the normal that it lets through: straight on, whatever its
/// roughness, without colour, and without what a volume absorbs.
float passed_by_glass(Material m, float cosine) {
    float of_interface = dielectric_fresnel(clamp(cosine, 1e-4, 1.0), m.ior);
    float reflected = m.thickness > 0.0 ? of_interface : sheet_reflectance(of_interface);
    return open_glass(m) * luminance(m.base_colour.rgb) * (1.0 - reflected);
}

/// Whether this ray passes it. `slope`: of the direction along the normal by the triangle's winding. The number that
/// decides is the ray's and that of one side of a material: of a pane that several discs stand for all say the same.
bool passes_glass(uint triangle, float slope, vec3 direction_ws) {
    uint material = hit_triangle_materials[triangle];
    float part = passed_by_glass(hit_materials[material], abs(slope));
    if (part == 0.0) return false;
    uint side = 2u * material + (slope > 0.0 ? 1u : 0u);
    return unit_float(pcg4d(uvec4(floatBitsToUint(direction_ws), side)).w) < part;
}

bool is_open_glass(uint triangle) { return open_glass(hit_materials[hit_triangle_materials[triangle]]) > 0.0; }
#endif
