// What may be a sheet of clear glass before a light. PASSED: the fraction of the light that it lets pass straight on,
// of which blending makes the product; else the depth of what lets none pass. MATERIALS: as Transport::Materials
// counts.
#define DISCARDS_EARLY
#include "passes/shadow/texel.glsl"
#include "lib/bsdf.glsl"

#ifdef PASSED
layout(location = 0) out vec4 passed;
#endif

/// As passes::Panes has it (renderers/passes/direct/panes.h), but none of what the G-buffer shows: it would shade itself.
vec3 passed_by_surface(Material material, vec3 direction) {
    if ((material.flags & MATERIAL_UNLIT) != 0u || emission(material) != vec3(0)) return vec3(0);
    vec3 geometric_n = dot(plane_normal_ws, direction) > 0.0 ? -plane_normal_ws : plane_normal_ws;
    vec2 reflection = metallic_roughness(material);
    vec3 colour = base_colour(material).rgb;
    Scatterer scatterer = make_scatterer(shading_normal(material, geometric_n), geometric_n, colour, reflection.x,
                                         reflection.y, material.ior, MATERIALS);
    float part = glass_fraction(material, reflection.x);
    if (part <= MOSTLY_GLASS) return vec3(0);
    Glass glass = make_glass(part, material.ior, material.thickness, colour, true);
    return passed_straight(scatterer, glass, -direction);
}

void main() {
    take_footprints();
    gl_FragDepth = texel_depth();
    vec3 part = passed_by_surface(materials[material_index], normalize(texel_direction()));
    if (has_hole_here()) discard;
#ifdef PASSED
    if (part == vec3(0)) discard;
    passed = vec4(part, 1);
#else
    if (part != vec3(0)) discard;
#endif
}
