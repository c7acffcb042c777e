/// Turns and shifts in a pattern of 4×4 pixels whose rows, columns and 2×2 blocks are evenly spread: Bayer's matrix,
/// read in three ways.
vec3 pattern_shift(ivec2 pixel) {
    const int bayer[16] = int[](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);
    ivec2 p = pixel & 3;
    ivec3 place = ivec3(4 * p.y + p.x, 4 * ((p.x + 1) & 3) + p.y, 4 * ((p.y + p.x + 2) & 3) + ((p.x + 3) & 3));
    return (vec3(bayer[place.x], bayer[place.y], bayer[place.z]) + 0.5) / 16.0;
}
