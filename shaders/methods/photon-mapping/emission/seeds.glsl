// Seeds of the points of a frame's emission sets, and the roulette that is played with them. Include
// emission_set.glsl before.

uniform uint all_points, stratum, seed_low, seed_high;

/// Index in the emission set of all sources and the whole cycle.
uint seed_of_item(uint item) { return stratum * all_points + item; }

float roulette_of_item(uint item) {
    return unit_float(pcg4d(uvec4(seed_of_item(item), seed_low, seed_high, EMISSION_ROULETTE)).x);
}
