// What exact rays of level 0 found. EXACT: there are any.

/// Of "splats.nearest": the other bits are a triangle.
// C++: ir::methods::deep_screen_space::exact_hit
const uint EXACT_HIT = 0x80000000u;

#if EXACT
/// A layer per sample: 1 + triangle that was met, 0 for none; and the distance in m up to which the ray is known, its
/// bits.
uniform usampler2DArray exact_rays;

/// Whether discs decide at this distance.
bool is_left_to_discs(ivec2 pixel, int sample_index, float distance_m) {
    uvec2 ray = texelFetch(exact_rays, ivec3(pixel, sample_index), 0).xy;
    return ray.x == 0u && distance_m > uintBitsToFloat(ray.y);
}
#endif
