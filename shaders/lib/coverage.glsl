// Whether a surface with an alpha mask is there: the rule of scene::is_covered, on the same bits.

/// One per material; width 0 where there is no mask.
// C++: ir::passes::OpacityData
struct OpacityBitmap {
    int width, height;
    uint first_word;  // rows are padded to 32 texels
    uint wraps;       // wrap in s, and in t << 4: 0 repeat, 1 mirrored repeat, 2 clamp to edge
};
layout(std430) readonly buffer Opacity { OpacityBitmap opacity[]; };
layout(std430) readonly buffer OpacityWords { uint opacity_words[]; };

/// Index of the nearest texel along one axis, in the arithmetic of scene::is_covered.
int nearest_texel(float coordinate, int size, uint wrap) {
    if (isnan(coordinate) || isinf(coordinate)) return 0;
    precise float folded = coordinate;
    if (wrap != 2u) {
        float whole = floor(coordinate);
        precise float fraction = coordinate - whole;
        // every float beyond 2^24 is even
        bool turned = wrap == 1u && abs(whole) < 16777216.0 && (int(whole) & 1) != 0;
        folded = turned ? 1.0 - fraction : fraction;
    }
    precise float texel = floor(folded * float(size));
    return int(clamp(texel, 0.0, float(size - 1)));
}

/// `uv` are the base colour's coordinates after its texture transform.
bool is_covered(uint material, vec2 uv) {
    OpacityBitmap bitmap = opacity[material];
    if (bitmap.width == 0) return true;
    uint x = uint(nearest_texel(uv.x, bitmap.width, bitmap.wraps & 15u));
    uint y = uint(nearest_texel(uv.y, bitmap.height, bitmap.wraps >> 4));
    uint words_per_row = (uint(bitmap.width) + 31u) / 32u;
    uint word = opacity_words[bitmap.first_word + y * words_per_row + x / 32u];
    return (word >> (x % 32u) & 1u) != 0u;
}
