// The sums by bounce as a table, and over all bounces as counters.
layout(local_size_x = 16) in;

#include "methods/photon-mapping/tracing/tally.glsl"

layout(std430) readonly buffer Sums { uint sums[]; };

// C++: ir::methods::photon_mapping::TallyRow
struct Row {
    uint bounce, rays, missed, stored, culled, absorbed, cut;
    float power[3];  // W
};
layout(std430) writeonly buffer Table { Row table[]; };
layout(std430) buffer RayCounter { uint ray_counter; };
layout(std430) buffer MissedCounter { uint missed_counter; };
layout(std430) buffer CulledCounter { uint culled_counter; };
layout(std430) buffer AbsorbedCounter { uint absorbed_counter; };
layout(std430) buffer CutCounter { uint cut_counter; };
#ifdef WEIGHS
layout(std430) buffer SeenCounter { uint seen_counter; };
#endif

uniform uint rows;
uniform float power_unit;

float watts(uint first, uint channel) {
    uint low = first + TALLY_POWER + 2u * channel;
    return (float(sums[low + 1u]) * 4294967296.0 + float(sums[low])) / TALLY_POWER_SCALE * power_unit;
}

void main() {
    uint bounce = gl_GlobalInvocationID.x;
    if (bounce >= rows) return;
    uint first = TALLY_WORDS * bounce;
    Row row = Row(bounce, sums[first + TALLY_RAYS], sums[first + TALLY_MISSED], sums[first + TALLY_STORED],
                  sums[first + TALLY_CULLED], sums[first + TALLY_ABSORBED], sums[first + TALLY_CUT],
                  float[3](watts(first, 0u), watts(first, 1u), watts(first, 2u)));
    table[bounce] = row;
    atomicAdd(missed_counter, row.missed);
    atomicAdd(culled_counter, row.culled);
    atomicAdd(absorbed_counter, row.absorbed);
    atomicAdd(cut_counter, row.cut);
#ifdef WEIGHS
    atomicAdd(seen_counter, sums[first + TALLY_SEEN]);
#endif
    if (bounce > 0u) atomicAdd(ray_counter, row.rays);
}
