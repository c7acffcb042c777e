// How many of each RUN of consecutive fine surfels are kept; 0 in what room there is behind them.
layout(local_size_x = 64) in;
#include "methods/deep-screen-space/surfels/thinning.glsl"

layout(std430) writeonly buffer Words { uint words[]; };
layout(std430) writeonly buffer WordCount { uint word_count; };

void main() {
    uint word = item_of_part();
    if (word == 0u) word_count = (fine_count + RUN - 1u) / RUN;
    if (word >= word_capacity) return;
    uint end = min((word + 1u) * RUN, min(fine_count, capacity)), kept = 0u;
    for (uint item = word * RUN; item < end; ++item)
        if (kept_area(fine_surfel(item)) > 0.0) ++kept;
    words[word] = kept;
}
