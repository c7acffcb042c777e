// Where the photons of a primary one land that leave along a direction of the maps. With RAYS the rays are traced
// already, else the maps answer: include passes/ldm/storage.glsl, trace.glsl, self_hit.glsl and entry_plane.glsl before.
#include "passes/ldm/frames.glsl"
#include "lib/spaces.glsl"
#include "methods/ldm-indirect/tracing/differentials.glsl"
#include "methods/ldm-indirect/tracing/primary.glsl"
#include "methods/ldm-indirect/tracing/landing.glsl"

/// Of the differential after the split, and of the region of directions that it is widened by.
Spread spread_of(Primary p) {
    float region = params.footprint == FOOTPRINT_WIDENED ? sqrt(2.0 / float(params.directions)) : 0.0;
    return Spread(length(vec2(length(p.axis_u), length(p.axis_v))),
                  length(vec3(length(p.turn_u), length(p.turn_v), region)),
                  params.clipping != CLIPPING_NONE);
}

#ifdef RAYS
#include "passes/raytracing/rays.glsl"
#include "passes/scene/hit_triangle.glsl"

layout(std430) readonly buffer RayHits { RayHit ray_hits[]; };

uniform float ray_start;  // m, from the surface

Landing way_of(Primary p, vec3 direction, uint ray) {
    if (dot(p.normal_ws, direction) <= 0.0) return Landing(CAUSE_BELOW, 0.0, vec3(0));
    RayHit hit = ray_hits[ray];
    if (!is_hit(hit)) return Landing(CAUSE_LEFT, 0.0, vec3(0));
    vec3 normal = hit_normal(hit.triangle, direction);
    bool has_surface = normal != vec3(0);
    return landing(p.position_ws, direction, ray_start + hit.distance, 0.0, vec3(0), vec3(0), spread_of(p),
                   has_surface ? normal : -direction, has_surface);
}
#else
/// `map` counts from the batch's first.
Landing way_of(Primary p, vec3 direction, MapFrame frame, uint map, bool forward) {
    if (dot(p.normal_ws, direction) <= 0.0) return Landing(CAUSE_BELOW, 0.0, vec3(0));
    LdmHit hit = ldm_trace(frame, map, p.position_ws, p.normal_ws, forward, LDM_FAR_QUANTA);
    if (!hit.found) return Landing(CAUSE_LEFT, 0.0, vec3(0));
    float distance = max(hit.distance, 0.0);
    vec3 normal = -direction;
    bool has_surface = false;
    if (params.landing == LANDING_PLANE) {
        LdmPlane plane = ldm_plane(frame, map, hit.texel, params.resolution, hit.entry);
        has_surface = plane.known;
        if (has_surface) {
            vec3 x = ldm_project(frame, p.position_ws);
            float entry = hit.entry + dot(plane.slope, x.xy - vec2(hit.texel) - 0.5);
            distance = max(forward ? entry - x.z : x.z - entry, 0.0);
            normal = ldm_normal(frame, plane, direction);
        }
    }
    return landing(p.position_ws, direction, distance * frame.direction.w,
                   entry_error(p.normal_ws, direction, frame.step_u.xyz, frame.step_v.xyz), frame.step_u.xyz,
                   frame.step_v.xyz, spread_of(p), normal, has_surface);
}
#endif
