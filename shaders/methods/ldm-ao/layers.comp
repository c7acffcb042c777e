// One map: the number of depths at each texel, and with POINTS each of them as a point of the scene.
layout(local_size_x = 8, local_size_y = 8) in;
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"

#ifdef POINTS
layout(std430, binding = 5) writeonly buffer Points { float points[]; };  // x, y, z, depth
layout(std430, binding = 6) buffer PointsAsked { uint points_asked; };
#else
layout(binding = 0, r32ui) uniform writeonly uimage2D layers;
#endif
uniform uint frame_index, map;  // among all maps; in the batch
uniform int resolution;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(resolution)))) return;
    uint count = 0u;
    for (LdmCursor c = ldm_first(map, texel, resolution); ldm_valid(c); c = ldm_next(c)) {
        ++count;
#ifdef POINTS
        MapFrame frame = ldm_frames[frame_index];
        float depth = float(ldm_depth(c));
        vec3 p = frame.step_u.xyz * (float(texel.x) + 0.5 - frame.u.w) +
                 frame.step_v.xyz * (float(texel.y) + 0.5 - frame.v.w) +
                 frame.direction.xyz * frame.direction.w * (depth - frame.depth.w);
        uint place = 4u * atomicAdd(points_asked, 1u);
        if (place + 3u >= uint(points.length())) continue;
        points[place] = p.x;
        points[place + 1u] = p.y;
        points[place + 2u] = p.z;
        points[place + 3u] = depth;
#endif
    }
#ifndef POINTS
    imageStore(layers, texel, uvec4(count));
#endif
}
