// Which fine surfels are kept. Twice: to count those of each RUN of consecutive ones, 0 in what room there is behind
// them, and (PACKS) to pack them, unlit. [Nalbach15 §4.3, fig. 6 c]
// DEVIATION [Nalbach15 §4.3]: by a prefix sum instead of a geometry shader; the same surfels in the same order.
layout(local_size_x = 64) in;
#include "lib/constants.glsl"
#include "lib/random.glsl"
#include "methods/deep-screen-space/surfels/holes.glsl"
#include "methods/deep-screen-space/surfels/fine.glsl"
#include "methods/deep-screen-space/surfels/parts.glsl"
#include "methods/deep-screen-space/records.glsl"

uniform uint capacity, word_capacity;

layout(std430) readonly buffer FineCount { uint fine_count; };

#if THINNING == 1
/// DEVIATION [Nalbach15 §4.3]: surfels are discarded with probability max(1 - A/A*, 0), and what is kept stands for
/// max(A, A*). As printed, max(1 - A*/A, 0), fine surfels, which are smaller than the ideal, would all be kept, and
/// each at its ideal area: 6.6 times the area of the surfaces in builtin:atrium, 4.5 times in Sponza (256²). As mended
/// it is 0.994 and 0.997 of it over 4 seeds; without thinning 0.995 and 0.996, as alpha masks have holes.
float kept_probability(float part) { return part; }
#elif THINNING == 2
float kept_probability(float part) { return 1.0 / part; }
#endif

/// The surfel's area, m²: 0 where it is discarded or an alpha mask has a hole.
float kept_area(FineSurfel s) {
    if (!is_surface_there(s.triangle, s.barycentrics)) return 0.0;
    float area = fine_area_of(s);
#if THINNING
    // All 32 bits: probabilities of tiny triangles are tiny.
    if (float(pcg(s.identity)) * (1.0 / 4294967296.0) >= kept_probability(s.part)) return 0.0;
#if THINNING == 1
    area /= min(s.part, 1.0);
#else
    area /= s.part;
#endif
#endif
    return area;
}

#if PACKS
layout(std430) readonly buffer Places { uint places[]; };
layout(std430) writeonly buffer Surfels { Surfel surfels[]; };

uniform uint surfel_capacity;

void pack(uint word, uint end) {
    uint place = places[word];
    for (uint item = word * RUN; item < end && place < surfel_capacity; ++item) {
        FineSurfel s = fine_surfel(item);
        float area = kept_area(s);
        if (!(area > 0.0)) continue;
        surfels[place] = Surfel(s.centre_ws, s.triangle, s.normal_ws, sqrt(area / PI), s.barycentrics, s.identity,
                                place, 0u);
        ++place;
    }
}
#else
layout(std430) writeonly buffer Words { uint words[]; };
layout(std430) writeonly buffer WordCount { uint word_count; };

void count(uint word, uint end) {
    uint kept = 0u;
    for (uint item = word * RUN; item < end; ++item)
        if (kept_area(fine_surfel(item)) > 0.0) ++kept;
    words[word] = kept;
}
#endif

void main() {
    uint word = item_of_part();
#if !PACKS
    if (word == 0u) word_count = (fine_count + RUN - 1u) / RUN;
#endif
    if (word >= word_capacity) return;
    uint end = min((word + 1u) * RUN, min(fine_count, capacity));
#if PACKS
    pack(word, end);
#else
    count(word, end);
#endif
}
