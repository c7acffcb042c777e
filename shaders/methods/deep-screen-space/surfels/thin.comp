// Packs the surfels that are kept, unlit.
// DEVIATION [Nalbach15 §4.3]: by a prefix sum instead of a geometry shader; the same surfels in the same order.
layout(local_size_x = 64) in;
#include "methods/deep-screen-space/surfels/thinning.glsl"
#include "methods/deep-screen-space/records.glsl"

layout(std430, binding = 2) readonly buffer Places { uint places[]; };
layout(std430, binding = 3) writeonly buffer Surfels { Surfel surfels[]; };

uniform uint first_item, end_item, capacity, surfel_capacity;

void main() {
    uint item = first_item + gl_GlobalInvocationID.x;
    if (item >= end_item || item >= min(fine_count, capacity)) return;
    FineSurfel s = fine_surfel(item);
    float area = kept_area(s);
    uint place = places[item];
    if (!(area > 0.0) || place >= surfel_capacity) return;
    surfels[place] = Surfel(s.centre_ws, s.triangle, s.normal_ws, sqrt(area / 3.14159265), vec3(0), s.barycentrics,
                            vec3(0), s.identity);
}
