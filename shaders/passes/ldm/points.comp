// One texel of the maps shown: with COUNT how many entries it has, else each of them as a point of the scene,
// without its face (faces.glsl).
layout(local_size_x = 64) in;
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"
#include "passes/ldm/point.glsl"

layout(std430) buffer LdmPointTexels { uint first_points[]; };
layout(std430) writeonly buffer LdmPoints { uint points[]; };

uniform uint first_frame, first_map, map_count;  // of those shown in the batch: among all maps; in the batch
uniform uint stride;                             // every so many texels are shown
uniform int resolution;

void main() {
    uint texels = uint(resolution * resolution), index = gl_GlobalInvocationID.x * stride;
    if (index >= map_count * texels) return;
    uint map = index / texels, rest = index % texels;
    ivec2 texel = ivec2(rest % uint(resolution), rest / uint(resolution));
    uint layer = 0u;
#ifdef COUNT
    for (LdmCursor c = ldm_first(first_map + map, texel, resolution); ldm_valid(c); c = ldm_next(c)) ++layer;
    first_points[gl_GlobalInvocationID.x] = layer;
#else
    MapFrame frame = ldm_frames[first_frame + map];
    uint place = first_points[gl_GlobalInvocationID.x], room = uint(points.length()) / POINT_WORDS;
    for (LdmCursor c = ldm_first(first_map + map, texel, resolution); ldm_valid(c); c = ldm_next(c)) {
        if (place >= room) return;
        uint depth = uint(ldm_depth(c)), word = POINT_WORDS * place;
        vec3 position = ldm_texel_centre_ws(frame, texel, float(depth));
        for (uint i = 0u; i < 3u; ++i) {
            points[word + i] = floatBitsToUint(position[i]);
            points[word + POINT_NORMAL + i] = 0u;
        }
        points[word + POINT_FACING] = 0u;
        points[word + POINT_DEPTH] = floatBitsToUint(ldm_metres(frame, depth));
        points[word + POINT_LAYER] = layer;
        points[word + POINT_MAP] = first_frame + map;
        ++layer;
        ++place;
    }
#endif
}
