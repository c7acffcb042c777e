// Counts and power by bounce, summed within a work group before they are added to the buffer. Power is counted
// in 1/65536 of a unit, so that the sum does not depend on the order. Row 0 is the sample points.

const uint TALLY_RAYS = 0u, TALLY_MISSED = 1u, TALLY_STORED = 2u, TALLY_CULLED = 3u, TALLY_ABSORBED = 4u,
           TALLY_CUT = 5u, TALLY_POWER = 6u,  // low and high words of red, green, blue
           TALLY_SEEN = 12u;                  // photons that raise the weight of their texel; only with weights
// C++: ir::methods::photon_mapping::*
const uint TALLY_WORDS = 13u, TALLY_ROWS = 16u;
const float TALLY_POWER_SCALE = 65536.0;

#ifdef TALLIES
layout(std430) buffer Tally { uint tally_sums[]; };

shared uint tally[TALLY_WORDS * TALLY_ROWS];

void begin_tally() {
    for (uint i = gl_LocalInvocationIndex; i < TALLY_WORDS * TALLY_ROWS; i += gl_WorkGroupSize.x)
        tally[i] = 0u;
    barrier();
}

void count(uint bounce, uint what) { atomicAdd(tally[TALLY_WORDS * bounce + what], 1u); }

void count_power(uint bounce, vec3 power) {
    uvec3 steps = uvec3(power * TALLY_POWER_SCALE + 0.5);  // of RGB9E5: below 2^32
    for (uint i = 0u; i < 3u; ++i) {
        uint low = TALLY_WORDS * bounce + TALLY_POWER + 2u * i;
        uint before = atomicAdd(tally[low], steps[i]);
        if (before + steps[i] < before) atomicAdd(tally[low + 1u], 1u);
    }
}

void end_tally() {
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < TALLY_WORDS * TALLY_ROWS; i += gl_WorkGroupSize.x) {
        uint word = i % TALLY_WORDS, amount = tally[i];
        if (amount == 0u) continue;
        uint before = atomicAdd(tally_sums[i], amount);
        bool is_low = word >= TALLY_POWER && word < TALLY_SEEN && (word - TALLY_POWER) % 2u == 0u;
        if (is_low && before + amount < before) atomicAdd(tally_sums[i + 1u], 1u);
    }
}
#endif
