// Writes what the light sees at the texel's centre.  [Smal19 §5.1]

#define DISCARDS_EARLY
#include "passes/shadow/texel.glsl"
#include "passes/rsm/cone.glsl"
#include "passes/rsm/opacity.glsl"

#ifdef DEPTH_PREPASS
uniform sampler2DArray depth_drawn_first;
uniform int layer;

/// Two programs may round one depth to different floats. What lies behind by less is left to the depth test.
const float ROUNDING = 1e-6;
#endif

uniform int opaque_only;  // 1: transmission is ignored

layout(location = 0) out vec4 albedo_roughness;
layout(location = 1) out vec4 normal_metalness;
#ifdef GEOMETRIC_NORMAL
layout(location = 2) out vec4 triangle_normal;
#endif

void main() {
    take_footprints();
    float depth = texel_depth();
#ifdef DEPTH_PREPASS
    if (depth > texelFetch(depth_drawn_first, ivec3(gl_FragCoord.xy, layer), 0).r + ROUNDING) discard;
#endif
    if (is_outside_cone() || has_hole_here()) discard;
    gl_FragDepth = depth;

    Material material = materials[material_index];
    vec2 reflection = metallic_roughness(material);
    float glass = glass_fraction(material, reflection.x);
    bool scatters = (material.flags & MATERIAL_UNLIT) == 0u &&
                    (opaque_only != 0 || glass <= MOSTLY_GLASS);
    // On the side of the light, as the G-buffer turns it to the viewer.
    vec3 geometric_normal_ws =
        dot(plane_normal_ws, texel_direction()) > 0.0 ? -plane_normal_ws : plane_normal_ws;
#ifdef GEOMETRIC_NORMAL
    bool has_glass = opaque_only == 0 && glass > 0.0;
    triangle_normal = vec4(geometric_normal_ws, has_glass ? 1.0 - glass : OPAQUE_INDEX + material.ior);
#endif
    albedo_roughness = vec4(base_colour(material).rgb, reflection.y);
    normal_metalness = vec4(shading_normal(material, geometric_normal_ws),
                            (scatters ? 1.0 : -1.0) * (1.0 + clamp(reflection.x, 0.0, 1.0)));
}
