// How far each pixel sees along each of some maps' directions, on its surface's side: where photons of these maps
// come from.
layout(local_size_x = 2, local_size_y = 8) in;
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"
#include "passes/ldm/trace.glsl"
#include "passes/ldm/self_hit.glsl"
#include "methods/ldm-indirect/seen.glsl"
#include "methods/ldm-indirect/looks.glsl"

layout(std430) writeonly buffer Looks { uint looks[]; };

/// Of the dispatch's maps.
uniform vec4 frame_rows[8 * 6];
uniform uint first_frame, first_map, map_count;  // among all maps; in the batch
uniform uint all_maps;
uniform float units_per_metre;

/// Of four pixels, 0 where there is no surface or it lies along the direction.
void main() {
    ivec2 first = ivec2(gl_GlobalInvocationID.xy) * ivec2(4, 1), size = textureSize(gbuffer_position, 0);
    if (any(greaterThanEqual(first, size))) return;
    vec3 position_ws[4], normal_ws[4];
    for (int j = 0; j < 4; ++j) {
        ivec2 pixel = first + ivec2(j, 0);
        bool inside = pixel.x < size.x;
        position_ws[j] = inside ? texelFetch(gbuffer_position, pixel, 0).xyz : vec3(0);
        normal_ws[j] = inside ? texelFetch(gbuffer_geometric_normal, pixel, 0).xyz : vec3(0);
    }
    for (uint i = 0u; i < map_count; ++i) {
        uint row = 6u * i, word = 0u;
        MapFrame frame = MapFrame(frame_rows[row], frame_rows[row + 1u], frame_rows[row + 2u], frame_rows[row + 3u],
                                  frame_rows[row + 4u], frame_rows[row + 5u]);
        for (int j = 0; j < 4; ++j) {
            float facing = dot(normal_ws[j], frame.direction.xyz);
            if (facing == 0.0) continue;
            LdmHit hit = ldm_trace(frame, first_map + i, position_ws[j], normal_ws[j], facing > 0.0, LDM_FAR_QUANTA);
            uint look =
                hit.found ? packed_look(hit.distance * frame.direction.w * units_per_metre) : OPEN_LOOK;
            word |= look << (8 * j);
        }
        looks[look_word(uvec2(first), uint(size.x), all_maps, first_frame + i)] = word;
    }
}
