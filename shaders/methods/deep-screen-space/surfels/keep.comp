// 1 for each fine surfel that is kept, 0 for the others and in what room there is behind them.
layout(local_size_x = 64) in;
#include "methods/deep-screen-space/surfels/thinning.glsl"

layout(std430, binding = 2) writeonly buffer Words { uint words[]; };
layout(std430, binding = 3) writeonly buffer WordCount { uint word_count; };

uniform uint first_item, end_item, capacity;

void main() {
    uint item = first_item + gl_GlobalInvocationID.x;
    if (item == 0u) word_count = fine_count;
    if (item >= end_item) return;
    words[item] = item < min(fine_count, capacity) && kept_area(fine_surfel(item)) > 0.0 ? 1u : 0u;
}
