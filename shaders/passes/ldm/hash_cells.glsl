// Where the entries of texels lie in a hash table. [Lefebvre13]
#include "lib/random.glsl"

/// The cells that all texels look at for their entries of one age are those of their numbers, moved by this: a number
/// below `size`.
uint hash_offset(uint age, uint size) {
    uint high, low;
    umulExtended(pcg(age), size, high, low);
    return high;
}

/// `texel` < `size`.
uint hash_cell(uint texel, uint age, uint size) {
    uint cell = texel + hash_offset(age, size);
    return cell < size ? cell : cell - size;
}

/// The texel that looks at the cell for its entry of this age.
uint hash_texel(uint cell, uint age, uint size) {
    uint offset = hash_offset(age, size);
    return cell < offset ? cell + (size - offset) : cell - offset;
}
