// Finds the rectangle of places that each surfel can affect on one level for one sample, and writes the command
// that draws them.  [Nalbach15 §4.1]
layout(local_size_x = 64) in;

#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/drawn_splat.glsl"
#include "methods/deep-screen-space/splatting/sub_image.glsl"

layout(std430) readonly buffer Stored { uint stored, made; };
layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) writeonly buffer Rectangles { uvec2 rectangles[]; };
layout(std430) writeonly buffer Draw { uint vertices, instances, first_vertex, base_instance; };
#ifdef COUNTS
layout(std430) buffer Drawn { uint drawn; };
layout(std430) buffer Culled { uint culled; };
#endif

uniform uint first, end;  // surfels
uniform uint level, sample_index, seed;
uniform ivec2 hierarchy_size;

shared uint group_drawn, group_culled;

/// First place, and the one after the last; both 0: none.
uvec2 rectangle_of(Surfel surfel, uint index) {
    DrawnSplat splat = drawn_splat(surfel, index, int(level));
    if (splat.fate == SPLAT_CULLED) atomicAdd(group_culled, 1u);
    if (splat.fate != SPLAT_DRAWN) return uvec2(0);
    atomicAdd(group_drawn, 1u);
    PixelRange range = splat.range;
    uvec2 corner = random_sub_image(surfel, level, sample_index, seed) * (uvec2(hierarchy_size) >> level);
    uvec2 begin = corner + (uvec2(range.first) >> level), after = corner + (uvec2(range.last) >> level) + 1u;
    return uvec2(begin.x | begin.y << 16, after.x | after.y << 16);
}

void main() {
    if (gl_LocalInvocationIndex == 0u) group_drawn = group_culled = 0u;
    barrier();
    uint i = first + gl_GlobalInvocationID.x, last = min(end, stored);
    if (gl_GlobalInvocationID.x == 0u) {
        vertices = 6u * (last - min(first, last));
        instances = 1u;
        first_vertex = 0u;  // one by one: the value of an assignment would be read
        base_instance = 0u;
    }
    if (i < last) rectangles[i - first] = rectangle_of(surfels[i], i);
#ifdef COUNTS
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        if (group_drawn > 0u) atomicAdd(drawn, group_drawn);
        if (group_culled > 0u) atomicAdd(culled, group_culled);
    }
#endif
}
