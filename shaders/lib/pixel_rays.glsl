// The ray through a point of the picture, in pixels from the upper left corner;
// renderers/passes/gbuffer/pixel_rays.h has the constants.

uniform vec3 ray_origin_ws, ray_origin_dx, ray_origin_dy;
uniform vec3 ray_direction_ws, ray_direction_dx, ray_direction_dy;

vec3 pixel_ray_origin(vec2 position_px) {
    return ray_origin_ws + position_px.x * ray_origin_dx + position_px.y * ray_origin_dy;
}

/// Advances by 1 along the view axis; not of unit length.
vec3 pixel_ray_direction(vec2 position_px) {
    return ray_direction_ws + position_px.x * ray_direction_dx + position_px.y * ray_direction_dy;
}

bool is_perspective() { return ray_origin_dx == vec3(0.0); }
