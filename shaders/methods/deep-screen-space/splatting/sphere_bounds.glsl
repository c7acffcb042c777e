// The part of the picture in which points of a sphere can be seen.

uniform mat4 view_from_world;
uniform vec2 pixel_scale, pixel_offset;  // view space to pixels: of x/-z and y/-z, or parallel of x and y
uniform float near_plane, far_plane;
uniform bool perspective;
uniform ivec2 view_size;

/// Rounding of projected points: no pixel's centre that is inside may fall out.
const float MARGIN_PX = 0.05;

/// Largest x / z of a disc at (x, z) cut off at z = near. The disc reaches beyond the near plane; z is depth,
/// positive in front of the eye.  [Mara13]
float max_slope(vec2 centre, float radius, float near) {
    float squared = dot(centre, centre), tangent = sqrt(max(squared - radius * radius, 0.0));
    // The point of tangency is the centre turned by the angle between it and the tangent, and shortened.
    vec2 touch = vec2(tangent * centre.x + radius * centre.y, tangent * centre.y - radius * centre.x);
    if (squared > radius * radius && touch.y * tangent >= near * squared) return touch.x / touch.y;
    float away = near - centre.y;
    return (centre.x + sqrt(max(radius * radius - away * away, 0.0))) / near;
}

/// First and last pixel, both inside, of what the sphere covers; last < first: nothing.
struct PixelRange {
    ivec2 first, last;
};
const PixelRange NO_PIXELS = PixelRange(ivec2(0), ivec2(-1));

PixelRange pixels_of_sphere(vec3 centre_ws, float radius) {
    vec3 centre = (view_from_world * vec4(centre_ws, 1)).xyz;
    float depth = -centre.z;
    if (depth + radius < near_plane || depth - radius > far_plane) return NO_PIXELS;
    vec2 least = centre.xy - radius, most = centre.xy + radius;
    if (perspective) {
        most = vec2(max_slope(vec2(centre.x, depth), radius, near_plane),
                    max_slope(vec2(centre.y, depth), radius, near_plane));
        least = -vec2(max_slope(vec2(-centre.x, depth), radius, near_plane),
                      max_slope(vec2(-centre.y, depth), radius, near_plane));
    }
    vec2 a = pixel_scale * least + pixel_offset, b = pixel_scale * most + pixel_offset;
    // Of pixels whose centres are at x + 1/2; far beyond the picture integers would overflow.
    vec2 begin = clamp(min(a, b), vec2(-1), vec2(view_size) + 1.0) - 0.5 - MARGIN_PX;
    vec2 end = clamp(max(a, b), vec2(-1), vec2(view_size) + 1.0) - 0.5 + MARGIN_PX;
    return PixelRange(max(ivec2(ceil(begin)), 0), min(ivec2(floor(end)), view_size - 1));
}
