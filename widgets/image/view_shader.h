#pragma once

namespace ir::widgets::view_shader {

// A triangle over the whole viewport; the picture's pixel is found from gl_FragCoord, so zoomed pixels have
// exact edges. This is a widget's own drawing, not a rendering pass, so it stands here.
inline constexpr const char* vertex = R"(#version 330 core
void main() {
    vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
)";

inline constexpr const char* fragment = R"(#version 330 core
uniform sampler2D picture, colour_map, cover_map;
uniform vec2 offset_px, picture_px;   // device pixels, from the top left; pixels of the picture
uniform float zoom, view_height, exposure, low, high;
uniform int mode, channels, channel, tone_map, pattern_half;
uniform bool mark_bad, negative_is_bad, zebra, hide_invalid, grey_zero, covered;
uniform vec3 surround, zero_grey;
out vec4 colour;

vec3 srgb(vec3 v) {
    v = clamp(v, 0.0, 1.0);
    return mix(1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, 12.92 * v, lessThanEqual(v, vec3(0.0031308)));
}
float fraction(float v) {
    return high == low ? (v > low ? 1.0 : 0.0) : clamp((v - low) / (high - low), 0.0, 1.0);
}
// Knuth's multiplicative hash, one octet per component.
vec3 id_colour(float v) {
    uint h = uint(int(v)) * 2654435761u;
    h ^= h >> 15u;
    h *= 2246822519u;
    h ^= h >> 13u;
    return vec3(64u + (h & 127u), 64u + ((h >> 8u) & 127u), 64u + ((h >> 16u) & 127u)) / 255.0;
}
vec3 tone_mapped(vec3 v) {
    v = min(max(v, 0.0) * exp2(exposure), 1e15);
    if (tone_map == 1) return v / (1.0 + dot(v, vec3(0.2126, 0.7152, 0.0722)));  // [Reinhard02 eq. 3]
    if (tone_map == 2) return v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14);  // [Narkowicz15]
    return v;
}
float largest_magnitude(vec3 v, int count) {
    float largest = v.x;
    if (count > 1 && abs(v.y) > abs(largest)) largest = v.y;
    if (count > 2 && abs(v.z) > abs(largest)) largest = v.z;
    return largest;
}
// A stripe has a black edge, so that it shows on any colour.
vec3 stripe(bool rising, vec3 stripe_colour, vec3 shaded) {
    ivec2 position = ivec2(gl_FragCoord.x, view_height - gl_FragCoord.y);
    int period = 2 * pattern_half;
    int at = (rising ? position.x + position.y : position.x - position.y + period * 65536) % period;
    return at >= pattern_half ? shaded : 3 * at < pattern_half ? vec3(0.0) : stripe_colour;
}
vec3 striped(vec3 shaded, vec3 v, int count) {
    float scale = mode == 0 ? exp2(exposure) : 1.0;
    float lowest = mode == 0 ? 0.0 : min(low, high), highest = mode == 0 ? 1.0 : max(low, high);
    if (mode == 2) v = vec3(largest_magnitude(v, count));
    if (mode != 2 && count == 2) v.z = v.x;  // what is not there is in range
    v *= scale;
    if (any(greaterThan(v, vec3(highest)))) return stripe(false, vec3(255.0, 60.0, 40.0) / 255.0, shaded);
    if (any(lessThan(v, vec3(lowest)))) return stripe(true, vec3(40.0, 90.0, 255.0) / 255.0, shaded);
    return shaded;
}
vec3 chequer() {
    ivec2 field = ivec2(gl_FragCoord.x, view_height - gl_FragCoord.y) / pattern_half;
    return vec3((field.x + field.y) % 2 == 0 ? 100.0 : 136.0) / 255.0;
}
vec3 shade(vec4 texel) {
    int count = min(channels, 3);
    if (channel >= 0) {
        texel = vec4(texel[min(channel, 3)]);
        count = 1;
    }
    vec3 v = count == 1 ? texel.xxx : count == 2 ? vec3(texel.xy, 0.0) : texel.xyz;
    if (mark_bad) {
        if (any(isnan(v))) return vec3(1.0, 0.0, 1.0);
        bvec3 infinite = isinf(v);
        if (any(infinite) && max(v.x, max(v.y, v.z)) > 3e38) return vec3(1.0, 1.0, 0.0);
        if (any(infinite)) return vec3(0.0, 1.0, 1.0);
        if (negative_is_bad && any(lessThan(v, vec3(0.0)))) return vec3(40.0, 80.0, 255.0) / 255.0;
    }
    if (mode == 3) return id_colour(v.x);
    if (mode == 2 && grey_zero && largest_magnitude(v, count) == 0.0) return zero_grey;
    vec3 shaded = mode == 0   ? srgb(tone_mapped(v))
                  : mode == 1 ? vec3(fraction(v.x), fraction(v.y), count == 2 ? 0.0 : fraction(v.z))
                              : texelFetch(colour_map, ivec2(int(fraction(largest_magnitude(v, count)) * 255.0 + 0.5), 0), 0).rgb;
    return zebra ? striped(shaded, v, count) : shaded;
}
vec3 colour_at(ivec2 pixel) {
    if (covered) {
        float cover = texelFetch(cover_map, pixel, 0).r;
        if (cover < 0.25) return surround;
        if (hide_invalid && cover < 0.75) return chequer();
    }
    return shade(texelFetch(picture, pixel, 0));
}
void main() {
    vec2 view = vec2(gl_FragCoord.x, view_height - gl_FragCoord.y);
    vec2 pixel = (view - offset_px) / zoom;
    if (any(lessThan(pixel, vec2(0.0))) || any(greaterThanEqual(pixel, picture_px))) {
        colour = vec4(surround, 1.0);
        return;
    }
    if (zoom >= 1.0) {
        colour = vec4(colour_at(ivec2(pixel)), 1.0);
        return;
    }
    // Smaller than life: the mean of the colours of a few pixels in the footprint, so that marks survive.
    int taps = min(int(ceil(1.0 / zoom)), 8);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < taps; ++j)
        for (int i = 0; i < taps; ++i) {
            vec2 at = pixel + ((vec2(i, j) + 0.5) / float(taps) - 0.5) / zoom;
            sum += colour_at(ivec2(clamp(at, vec2(0.0), picture_px - 1.0)));
        }
    colour = vec4(sum / float(taps * taps), 1.0);
}
)";

}  // namespace ir::widgets::view_shader
