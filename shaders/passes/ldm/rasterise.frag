// Raster builder: every fragment is kept.
#include "passes/ldm/triangle.glsl"
#include "passes/ldm/fragments.glsl"
#ifdef MASKED
#include "passes/ldm/mask.glsl"
#endif
#ifdef DIRECT
#include "passes/ldm/direct_list.glsl"
#endif

uniform uint first_map, first_triangle;
uniform int resolution;

flat in uint map;
noperspective in float depth_quanta;
#ifdef MASKED
noperspective in vec2 uv0;
noperspective in vec2 uv1;
#endif

/// Slope, in quanta per texel, from which on what the rasteriser extrapolates beyond a sliver's edge matters.
const float STEEP = 4096.0;

void main() {
    float depth = depth_quanta;
    float slope = fwidth(depth_quanta);
#ifdef LDM_SLOPES
    triangle_slopes = ldm_slope_codes(vec2(dFdx(depth_quanta), dFdy(depth_quanta)),
                                      ldm_texel_quanta(ldm_frames[first_map + map]));
#endif
    uint triangle = first_triangle + uint(gl_PrimitiveID);
#ifdef MASKED
    uint material = scene_triangle_materials[triangle];
    if (!is_covered(material, uv_of_slot(ldm_materials[material].base_colour_slot, uv0, uv1))) return;
#endif
    if (!(slope < STEEP)) {
        uvec3 corners = scene_triangle(triangle);
        MapTriangle t = projected(scene_position_ws(corners.x), scene_position_ws(corners.y),
                                  scene_position_ws(corners.z), ldm_frames[first_map + map]);
        float least = min(min(t.depth.x, t.depth.y), t.depth.z);
        float most = max(max(t.depth.x, t.depth.y), t.depth.z);
        depth = depth >= least ? min(depth, most) : least;  // also where it is not a number
    }
#ifdef LDM_FACES
    set_face(scene_triangle(triangle));
#endif
    ivec2 texel = ivec2(gl_FragCoord.xy);
    uint index = (map * uint(resolution) + uint(texel.y)) * uint(resolution) + uint(texel.x);
#ifdef DIRECT
    insert_directly(index, quantised(depth));
#else
    put_fragment(reserve_fragments(1u), index, quantised(depth));
#endif
}
