// The unit sphere around the origin, as the rays of the picture meet it. Include after lib/pixel_rays.glsl.

const uint NOT_ON_SPHERE = 0xffffffffu;  // in the picture of regions; 0: no region; else its element plus 1

// The point of the sphere at this place of the picture; false where the sphere is not.
bool sphere_point(vec2 position_px, out vec3 point) {
    vec3 o = pixel_ray_origin(position_px), d = pixel_ray_direction(position_px);
    float dd = dot(d, d), middle = -dot(o, d) / dd;
    vec3 nearest = o + middle * d;
    float inside = 1.0 - dot(nearest, nearest);
    point = vec3(0);
    if (inside < 0.0) return false;
    float half_chord = sqrt(inside / dd), t = middle - half_chord;
    if (t <= 0.0) t = middle + half_chord;  // from within
    point = normalize(o + t * d);
    return t > 0.0;
}
