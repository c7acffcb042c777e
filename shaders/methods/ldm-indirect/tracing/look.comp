// How far each pixel sees along each of some maps' directions, on its surface's side: where photons of these maps
// come from.
layout(local_size_x = 8, local_size_y = 8) in;
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"
#include "passes/ldm/trace.glsl"
#include "passes/ldm/self_hit.glsl"
#include "methods/ldm-indirect/looks.glsl"

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_geometric_normal;
layout(std430) buffer Looks { uint looks[]; };

/// Of the dispatch's maps.
uniform vec4 frame_rows[8 * 6];
uniform uint first_frame, first_map, map_count;  // among all maps; in the batch
uniform float units_per_metre;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = textureSize(gbuffer_position, 0);
    if (any(greaterThanEqual(pixel, size))) return;
    vec3 normal_ws = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    if (normal_ws == vec3(0)) return;
    vec3 position_ws = texelFetch(gbuffer_position, pixel, 0).xyz;
    for (uint i = 0u; i < map_count; ++i) {
        uint row = 6u * i;
        MapFrame frame = MapFrame(frame_rows[row], frame_rows[row + 1u], frame_rows[row + 2u], frame_rows[row + 3u],
                                  frame_rows[row + 4u], frame_rows[row + 5u]);
        bool forward = dot(normal_ws, frame.direction.xyz) > 0.0;
        LdmHit hit = ldm_trace(frame, first_map + i, position_ws, normal_ws, forward, LDM_FAR_QUANTA);
        uint look = hit.found ? packed_look(hit.distance * frame.direction.w * units_per_metre) : OPEN_LOOK;
        uint word = look_word(pixel, size, first_frame + i);
        looks[word] = bitfieldInsert(looks[word], look, int(8u * ((first_frame + i) % 4u)), 8);
    }
}
