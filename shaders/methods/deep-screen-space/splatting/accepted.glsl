// Which of the discs that a ray meets count. DISCS: as Discs counts; CLIPPED: discs end where their surface does;
// OPEN_BACKS: surfels are open from behind; GLASS: glass lets rays through.
#include "methods/deep-screen-space/splatting/exact.glsl"
#if GLASS
#include "passes/scene/hit_materials.glsl"
#endif
#include "methods/deep-screen-space/splatting/glass.glsl"

#if DISCS == 2 || CLIPPED
#include "passes/raytracing/bvh.glsl"
#endif

#if CLIPPED
/// Part of the disc's radius by which its surface may lie off its plane, as curved ones do.
// C++: ir::methods::deep_screen_space::splat_depth
const float SPLAT_DEPTH = 0.15;

/// Whether a triangle is where the ray meets the disc, by a short ray along the disc's normal.
/// DEVIATION [Nalbach15 §4.1]: discs reach beyond the border of the surface that they stand for.
bool splat_is_on_surface(vec3 met_ws, Surfel s, float disc_radius) {
    float depth = SPLAT_DEPTH * disc_radius;
    RayHit hit;
    find_first_hit(Ray(met_ws + depth * s.normal_ws, 2.0 * depth, -s.normal_ws, 1.0), hit);
    return is_hit(hit);
}
#endif

#if DISCS == 2
#include "passes/raytracing/ray_offset.glsl"

/// Part of the disc's radius by which its centre is lifted towards the ray, so that a curved or crumpled surface does
/// not hide its own.
// C++: ir::methods::deep_screen_space::splat_lift
const float SPLAT_LIFT = 0.05;
/// Part of the way there that must be free: at its end the surface itself is met.
// C++: ir::methods::deep_screen_space::splat_free_way
const float SPLAT_FREE_WAY = 0.999;

/// Whether nothing lies between x_p and the disc's centre.
/// DEVIATION [Nalbach15 §3.2]: no such test. Enlarged discs reach around edges and into what is closed; there they
/// hide what the ray would meet, and what they send is what arrives somewhere else.
bool splat_is_seen(vec3 x_ws, vec3 geometric_normal_ws, vec3 direction_ws, Surfel s, float disc_radius) {
    vec3 origin = offset_origin(x_ws, geometric_normal_ws);
    vec3 facing = dot(s.normal_ws, direction_ws) > 0.0 ? -s.normal_ws : s.normal_ws;
    vec3 way = s.centre_ws + SPLAT_LIFT * disc_radius * facing - origin;
    float distance_m = length(way);
    vec3 to_centre = way / distance_m;
    float far = SPLAT_FREE_WAY * distance_m;
    RayHit hit;
    find_first_hit(Ray(origin, far, to_centre, 0.0), hit);
#if GLASS
    for (int pane = 0; pane < MAX_PANES && is_hit(hit) && is_open_glass(hit.triangle); ++pane) {
        float step = hit.distance + ray_offset(origin + hit.distance * to_centre);
        origin += step * to_centre;
        far -= step;
        find_first_hit(Ray(origin, far, to_centre, 0.0), hit);
    }
#endif
    return !is_hit(hit);
}
#endif

/// `x_ws` and `geometric_normal_ws` are of the receiver at `pixel`, `hit` is what the disc does to its ray.
bool splat_is_accepted(Surfel s, SplatHit hit, ivec2 pixel, int sample_index, vec3 x_ws, vec3 direction_ws,
                       vec3 geometric_normal_ws) {
#if EXACT
    if (!is_left_to_discs(pixel, sample_index, hit.distance_m)) return false;
#endif
#if OPEN_BACKS
    if (dot(s.normal_ws, direction_ws) > 0.0) return false;
#endif
#if DISCS >= 1
    if (!splat_is_above(x_ws, geometric_normal_ws, s.centre_ws)) return false;
#endif
#if GLASS
    if (passes_glass(s.triangle, dot(s.normal_ws, direction_ws), direction_ws)) return false;
#endif
#if CLIPPED
    if (!splat_is_on_surface(x_ws + hit.distance_m * direction_ws, s, hit.disc_radius)) return false;
#endif
#if DISCS == 2
    if (!splat_is_seen(x_ws, geometric_normal_ws, direction_ws, s, hit.disc_radius)) return false;
#endif
    return true;
}
