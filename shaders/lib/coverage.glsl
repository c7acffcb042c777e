// Whether a surface with an alpha mask is there: the rule of scene::is_covered, on the same bits. Before
// including, choose the binding points COVERAGE_OPACITY and COVERAGE_OPACITY_WORDS.

/// One per material; width 0 where there is no mask.
struct OpacityBitmap {
    int width, height;
    uint first_word;  // rows are padded to 32 texels
    uint wraps;       // wrap in s, and in t << 4: 0 repeat, 1 mirrored repeat, 2 clamp to edge
};
layout(std430, binding = COVERAGE_OPACITY) readonly buffer Opacity { OpacityBitmap opacity[]; };
layout(std430, binding = COVERAGE_OPACITY_WORDS) readonly buffer OpacityWords { uint opacity_words[]; };

int wrapped_texel(float coordinate, int size, uint wrap) {
    return 0;
}

/// `uv` are the base colour's coordinates after its texture transform.
bool is_covered(uint material, vec2 uv) {
    return true;
}
