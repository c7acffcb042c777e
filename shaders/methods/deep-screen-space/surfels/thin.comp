// Packs the surfels that are kept, unlit.
// DEVIATION [Nalbach15 §4.3]: by a prefix sum instead of a geometry shader; the same surfels in the same order.
layout(local_size_x = 64) in;
#include "lib/constants.glsl"
#include "methods/deep-screen-space/surfels/thinning.glsl"
#include "methods/deep-screen-space/records.glsl"

layout(std430) readonly buffer Places { uint places[]; };
layout(std430) writeonly buffer Surfels { Surfel surfels[]; };

uniform uint surfel_capacity;

void main() {
    uint word = item_of_part();
    if (word >= word_capacity) return;
    uint end = min((word + 1u) * RUN, min(fine_count, capacity)), place = places[word];
    for (uint item = word * RUN; item < end && place < surfel_capacity; ++item) {
        FineSurfel s = fine_surfel(item);
        float area = kept_area(s);
        if (!(area > 0.0)) continue;
        surfels[place] = Surfel(s.centre_ws, s.triangle, s.normal_ws, sqrt(area / PI), s.barycentrics, s.identity,
                                place, 0u);
        ++place;
    }
}
