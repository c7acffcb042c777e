// Which fine surfels are kept. [Nalbach15 §4.3, fig. 6 c]
#include "lib/random.glsl"
#include "methods/deep-screen-space/surfels/holes.glsl"
#include "methods/deep-screen-space/surfels/fine.glsl"
#include "methods/deep-screen-space/surfels/parts.glsl"

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
