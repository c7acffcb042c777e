// Textures in one array (renderers/passes/scene/texel_buffer.h), looked up as passes::HostTexture does:
// bilinear at the finest level where the sampler says linear, sRGB decoded before filtering.
// [OpenGL 4.5 core §8.14.2, §8.24]

layout(std430) readonly buffer Texels { uint texel_words[]; };

// How a coordinate outside [0, 1] is taken, in the order of scene::Wrap; and the flags above two of those.
// C++: ir::passes::*
const uint TEXELS_REPEATED = 0u, TEXELS_MIRRORED = 1u, TEXELS_CLAMPED = 2u, TEXELS_LINEAR = 16u, TEXELS_SRGB = 32u;

struct TexelTable {
    uint first;
    ivec2 size;  // 0: not there
    uvec2 wraps;
    bool is_linear, is_srgb;
};

TexelTable texel_table(int texture) {
    uint head = 256u + 4u * uint(texture);
    uint size = texel_words[head + 1u], flags = texel_words[head + 2u];
    return TexelTable(texel_words[head], ivec2(size & 0xffffu, size >> 16u),
                      uvec2(flags & 3u, flags >> 2u & 3u), (flags & TEXELS_LINEAR) != 0u, (flags & TEXELS_SRGB) != 0u);
}

/// Into [0, 1]; from 2^23 on floats are whole numbers, which repeat as 0.
float folded_coordinate(float coordinate, uint wrap) {
    if (isnan(coordinate) || isinf(coordinate)) return 0.0;
    if (wrap == TEXELS_CLAMPED) return clamp(coordinate, 0.0, 1.0);
    if (abs(coordinate) >= 8388608.0) return 0.0;
    float whole = floor(coordinate);
    float fraction = coordinate - whole;
    return wrap == TEXELS_MIRRORED && (int(whole) & 1) != 0 ? 1.0 - fraction : fraction;
}

/// Texels -1 and `size` beside a folded coordinate.
int wrapped_texel(int texel, int size, uint wrap) {
    if (wrap != TEXELS_REPEATED) return clamp(texel, 0, size - 1);
    return texel < 0 ? size - 1 : texel >= size ? 0 : texel;
}

vec3 texel_at(TexelTable t, int x, int y) {
    uint word = texel_words[t.first + uint(y * t.size.x + x)];
    if (!t.is_srgb) return unpackUnorm4x8(word).rgb;
    return vec3(uintBitsToFloat(texel_words[word & 255u]), uintBitsToFloat(texel_words[word >> 8u & 255u]),
                uintBitsToFloat(texel_words[word >> 16u & 255u]));
}

/// RGB of a texture at transformed coordinates; white where it is not there.
vec3 texture_at(int texture, vec2 uv) {
    TexelTable t = texel_table(texture);
    if (t.size.x == 0) return vec3(1);
    uv = vec2(folded_coordinate(uv.x, t.wraps.x), folded_coordinate(uv.y, t.wraps.y)) * vec2(t.size);
    if (!t.is_linear) {
        ivec2 nearest = min(ivec2(uv), t.size - 1);
        return texel_at(t, nearest.x, nearest.y);
    }
    uv -= 0.5;
    vec2 corner = floor(uv);
    vec2 part = uv - corner;
    int left = wrapped_texel(int(corner.x), t.size.x, t.wraps.x);
    int right = wrapped_texel(int(corner.x) + 1, t.size.x, t.wraps.x);
    int top = wrapped_texel(int(corner.y), t.size.y, t.wraps.y);
    int bottom = wrapped_texel(int(corner.y) + 1, t.size.y, t.wraps.y);
    vec3 upper = mix(texel_at(t, left, top), texel_at(t, right, top), part.x);
    return mix(upper, mix(texel_at(t, left, bottom), texel_at(t, right, bottom), part.x), part.y);
}
