// From world to clip space, and quads of a width in pixels.

uniform mat4 clip_from_world;
uniform vec2 size_px;      // of the picture
uniform float min_w;     // clip-space w of the nearest place that is drawn; orthographic: below 1

const vec4 outside = vec4(-2, -2, 0, 1);  // nothing is drawn there

vec4 clip_position(vec3 position_ws) { return clip_from_world * vec4(position_ws, 1); }

// Cuts what lies behind the eye off a segment; false where nothing is left.
bool clip_segment(inout vec4 a, inout vec4 b) {
    if (a.w < min_w && b.w < min_w) return false;
    if (a.w < min_w) a = mix(b, a, (b.w - min_w) / (b.w - a.w));
    if (b.w < min_w) b = mix(a, b, (a.w - min_w) / (a.w - b.w));
    return true;
}

// Corner 0…5 of the two triangles of a quad: x along, y across, each -1 or 1.
vec2 quad_corner(int corner) {
    int c = corner < 3 ? corner : corner == 3 ? 2 : corner == 4 ? 1 : 3;
    return vec2((c & 1) == 0 ? -1.0 : 1.0, (c & 2) == 0 ? -1.0 : 1.0);
}

// A corner of the band of `width_px` around the segment a–b, both in front of the eye, that ends
// `overhang_px` beyond its ends.
vec4 band_corner(vec4 a, vec4 b, vec2 corner, float width_px, float overhang_px) {
    vec2 a_px = 0.5 * size_px * a.xy / a.w, b_px = 0.5 * size_px * b.xy / b.w;
    vec2 along = b_px - a_px;
    float span = length(along);
    along = span > 1e-6 ? along / span : vec2(1, 0);
    vec2 across = vec2(-along.y, along.x);
    vec4 at = corner.x < 0.0 ? a : b;
    vec2 moved_px = 0.5 * width_px * corner.y * across + overhang_px * corner.x * along;
    return vec4(at.xy + moved_px / (0.5 * size_px) * at.w, at.zw);
}
