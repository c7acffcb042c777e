// Parts of triangles that the tessellator can divide into surfels: a triangle is split into m² that are similar
// to it. 16 bytes in std430.
// C++: ir::methods::deep_screen_space::Patch
struct Patch {
    uint triangle;
    uint splits;  // of each side
    uint place;  // bits 0-11, 12-23: column and row of the part's corner; bit 24: it is turned by half a turn
    uint level;  // of tessellation; 0 as long as it is not known
};

// C++: ir::methods::deep_screen_space::max_splits
const uint MAX_SPLITS = 64u;  // of a side, in each of the two rounds
const uint MAX_LEVEL = 64u;   // every device has it

uint patch_place(uvec2 corner, bool is_turned) { return corner.x | corner.y << 12u | (is_turned ? 1u << 24u : 0u); }
uvec2 patch_corner(Patch p) { return uvec2(p.place & 4095u, p.place >> 12u & 4095u); }
bool patch_is_turned(Patch p) { return (p.place >> 24u & 1u) != 0u; }

/// Weights of the triangle's second and third corner at a point of the patch, given by the patch's.
vec2 patch_weights(Patch p, vec2 uv) {
    vec2 corner = vec2(patch_corner(p));
    return (patch_is_turned(p) ? corner + 1.0 - uv : corner + uv) / float(p.splits);
}

/// The part in column and row of `splits` along each side of the patch.
Patch patch_part(Patch p, uint splits, uvec2 corner, bool is_turned) {
    uvec2 base = patch_corner(p);
    uvec2 part = patch_is_turned(p) ? (base + 1u) * splits - corner - 1u : base * splits + corner;
    return Patch(p.triangle, p.splits * splits, patch_place(part, is_turned != patch_is_turned(p)), 0u);
}

// Of systematic placement.
// C++: ir::methods::deep_screen_space::units_of_surfel
const uint UNITS_OF_SURFEL = 256u;  // where surfels are counted in parts
// C++: ir::methods::deep_screen_space::surfels_of_patch
const float SURFELS_OF_PATCH = 16.0;  // at most
/// Of a patch, in distances: within it all surfels are of equal area.
// C++: ir::methods::deep_screen_space::max_patch_length
const float MAX_PATCH_LENGTH = 0.3;

/// How many distinct vertices the tessellator makes of a triangle whose levels are all n, equally spaced: rings of
/// 3k with k = n, n - 2, …, and where n is even the middle. [OpenGL 4.5 core §11.2.2.2]
uint tessellated_points(uint n) {
    return (n & 1u) == 0u ? 3u * n * (n + 2u) / 4u + 1u : 3u * ((n + 1u) / 2u) * ((n + 1u) / 2u);
}

/// The lowest level with at least so many points, or the highest one.
uint level_for(float points) {
    return uint(clamp(ceil(sqrt(points * (4.0 / 3.0)) - 1.0), 1.0, float(MAX_LEVEL)));
}
