// What a surfel does to a ray of a pixel: the same for splatting and for its explanation. Constants: VisibleLevel of
// renderers/methods/deep-screen-space/splatting/visible.h. Include records.glsl before it.
#include "methods/deep-screen-space/splatting/influence.glsl"

uniform float coverage, max_distance;
uniform bool full_discs;

/// What one level needs to know of a surfel.
struct SplatLevel {
    int level;           // of the framebuffer: l
    float shell_radius;  // m: d of the surfel
    float whole_reach;   // m: where all shells end
    float coverage;      // area of the disc that is tested, in areas of its surfel
    float max_distance;  // m; 0: no limit
    bool full_discs;     // inner shells count, too
    bool is_open;        // its shell ends where all shells end
};

SplatLevel splat_level(int level, Surfel surfel) {
    return SplatLevel(level, first_shell(surfel.radius), whole_reach, coverage, max_distance, full_discs,
                      level == open_level);
}

/// The level whose shell around the surfel holds x_p: [0, d], then (d 2^(k-1), d 2^k], as far as they reach, the last
/// one if open as far as all; -1 where
/// level l does not draw it.  [Nalbach15 §4.1, §4.3]
int splat_shell(SplatLevel l, vec3 x_ws, vec3 centre_ws) {
    precise vec3 offset = centre_ws - x_ws;
    precise float squared = dot(offset, offset);
    float reach = l.shell_radius * l.shell_radius;
    if (squared > l.whole_reach * l.whole_reach) return -1;
    int k = 0;
    while (k < l.level && squared > reach) {
        reach *= 4.0;
        ++k;
    }
    if ((squared > reach && !l.is_open) || (!l.full_discs && k != l.level)) return -1;
    return k;
}

/// Seen with probability 4^-k, a disc of the k-th shell stands for 4^k surfels.  [Nalbach14]
/// DEVIATION [Nalbach15 §4.1]: discs of the mesh's own area, placed independently, let 1/e of all rays through a
/// closed surface; `coverage` times their area leaves exp(-coverage).
float splat_disc_radius(SplatLevel l, int shell, float surfel_radius) {
    return ldexp(sqrt(l.coverage) * surfel_radius, shell);
}

/// Where the ray meets the disc's plane, m; not a number or infinite where it does not.
float splat_plane_distance(vec3 x_ws, vec3 direction_ws, vec3 centre_ws, vec3 normal_ws) {
    precise float height = dot(normal_ws, centre_ws - x_ws), slope = dot(normal_ws, direction_ws);
    return height / slope;
}

bool splat_is_on_disc(vec3 x_ws, vec3 direction_ws, vec3 centre_ws, float t, float radius) {
    precise vec3 offset = t * direction_ws - (centre_ws - x_ws);
    precise float squared = dot(offset, offset);
    return squared <= radius * radius;
}

/// Rounding of positions in the G-buffer and of surfels' centres, as a part of the coordinates.
// C++: ir::methods::deep_screen_space::splat_rounding
const float SPLAT_ROUNDING = 4e-6;

/// Whether the surfel's centre, a point of the surface, lies above the plane of x_p's triangle.
/// DEVIATION [Nalbach15 §3.2]: the source has no rule against a surface that shades itself. Enlarged discs reach
/// beyond the surface that they stand for, and a ray from within the reach of its own surface's discs would meet
/// them at once. No convex surface has a centre above the plane of one of its own triangles, and on a flat one
/// all lie in it, so that both are free of it without a tolerance to be tuned. Wrong only of surfaces that
/// cross the plane: of theirs the half of discs whose centres are below is missing in a band as wide as a disc.
bool splat_is_above(vec3 x_ws, vec3 geometric_normal_ws, vec3 centre_ws) {
    precise float height = dot(geometric_normal_ws, centre_ws - x_ws);
    vec3 size = max(abs(x_ws), abs(centre_ws));
    return height > SPLAT_ROUNDING * max(size.x, max(size.y, size.z));
}

/// Up to which z is linear.
// C++: ir::methods::deep_screen_space::splat_last_z
const float SPLAT_LAST_Z = 0.999;

/// z in [0, 1), as written into all framebuffers.
/// DEVIATION [Nalbach15 §3.2]: divided by r², with r the reach of all levels, in place of the printed d_max², which
/// clips all hits of levels from 1 on. Shells are by the distance to centres: hits of large discs lie a little
/// beyond r; z is linear up to 0.999, and the rest of [0, ∞) shares what is left, in order.
float splat_z(SplatLevel l, float t) {
    precise float z = t * t / (l.whole_reach * l.whole_reach);
    return z < SPLAT_LAST_Z ? z : 1.0 - (1.0 - SPLAT_LAST_Z) * (SPLAT_LAST_Z / z);
}

// What becomes of a splat on a pixel, in the order of the tests.
const int SPLAT_NONE = 0;     // it does not cover the pixel
const int SPLAT_OUTSIDE = 1;  // x_p lies in no shell of the level
const int SPLAT_MISSED = 2;   // the ray misses the disc, or meets its plane behind x_p
const int SPLAT_TOO_FAR = 3;  // beyond the maximum distance
const int SPLAT_REFUSED = 4;  // it does not count for this receiver: accepted.glsl
const int SPLAT_HIT = 5;      // met; of explanations: but something is nearer on this level
const int SPLAT_LEVEL = 6;    // the nearest on its level, but another one decides
const int SPLAT_WINS = 7;

struct SplatHit {
    int outcome;
    float distance_m, z, disc_radius;
};

/// The ray from x_p against the disc for a shell of 0 or more; SPLAT_REFUSED is left to test.
SplatHit splat_hit(SplatLevel l, int shell, vec3 x_ws, vec3 direction_ws, vec3 centre_ws, vec3 normal_ws,
                   float surfel_radius) {
    SplatHit hit = SplatHit(SPLAT_MISSED, splat_plane_distance(x_ws, direction_ws, centre_ws, normal_ws), 1.0,
                            splat_disc_radius(l, shell, surfel_radius));
    if (!(hit.distance_m > 0.0) || !splat_is_on_disc(x_ws, direction_ws, centre_ws, hit.distance_m, hit.disc_radius))
        return hit;
    hit.z = splat_z(l, hit.distance_m);
    hit.outcome = l.max_distance > 0.0 && hit.distance_m > l.max_distance ? SPLAT_TOO_FAR : SPLAT_HIT;
    return hit;
}
