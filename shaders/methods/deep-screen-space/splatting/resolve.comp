// What the surfels that rays met send towards the pixels. [Nalbach15 §3.2]
// AVERAGED: discs send the mean of what they stand for. BLACK_BACKS: nothing from behind; GLOSSY_SENDERS: with
// highlights. EXTENDED: senders are lit by sources with an extent, too. GLASS: glass lets rays through. MATERIALS: as
// sent.glsl has them.
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/exact.glsl"
#if GLOSSY_SENDERS || EXACT || GLASS
#include "passes/scene/hit_materials.glsl"
#include "passes/scene/hit_triangle.glsl"
#endif
#include "methods/deep-screen-space/splatting/glass.glsl"
#include "passes/bounce/tiles.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) readonly buffer SurfelLights { SurfelLight surfel_lights[]; };
layout(std430) readonly buffer Stored { uint stored, made; };

uniform usampler2DArray nearest;
uniform sampler2DArray directions;
layout(rgba32f) uniform writeonly image2DArray incoming;

#include "methods/deep-screen-space/splatting/visible_hit.glsl"
#include "methods/deep-screen-space/splatting/disc_light.glsl"

#if GLOSSY_SENDERS || EXACT
#include "methods/deep-screen-space/surfels/sent.glsl"
#endif
#if GLOSSY_SENDERS
#include "methods/deep-screen-space/splatting/resolve_glossy.glsl"

uniform float highlight_share;  // of the solid angle 1 / density; 0: rays stand for points

/// What of a sender one ray stands for. DEVIATION [Nalbach15 §3.2]: a ray shows what its one direction has.
float ray_slope_variance(uint triangle, float distance_m, float density) {
    if (highlight_share == 0.0) return 0.0;
    return slope_variance(triangle, distance_m, highlight_share / density);
}
#endif

uniform sampler2D gbuffer_position;
uniform int levels;
uniform int first_sample;  // of the batch
uniform uint seed;

/// Which the disc was enlarged for: that in which x_p lies.
int shell_at(SplatLevel l, Surfel s, vec3 x_ws) {
    l.full_discs = true;
    return max(splat_shell(l, x_ws, s.centre_ws), 0);
}

vec3 sent_by_disc(uint index, vec4 ray, ivec3 at) {
    vec3 direction_ws = ray.xyz;
    Surfel s = surfels[index];
    vec3 x_ws = texelFetch(gbuffer_position, at.xy, 0).xyz;
    SplatLevel l = splat_level(levels - 1, s);
    int shell = shell_at(l, s, x_ws);
    vec3 radiance = light_of_disc(l, index, shell, dot(s.normal_ws, direction_ws) <= 0.0,
                                  unit_float(pcg4d(uvec4(at.xy, first_sample + at.z, seed)).w));
#if GLOSSY_SENDERS
    float distance_m = splat_plane_distance(x_ws, direction_ws, s.centre_ws, s.normal_ws);
    float variance = disc_slope_variance(s.radius, shell, distance_m) +
                     ray_slope_variance(s.triangle, distance_m, ray.w);
    radiance += sent_to_one_side(s, direction_ws, variance);
#endif
    return radiance;
}

#if EXACT
uniform sampler2DArray distances;

/// A surfel of no size where a ray met a triangle.
Surfel point_of(uint triangle, vec3 position_ws) {
    uvec3 first = hit_corners(triangle);
    vec3 a = hit_vertices[first.x].xyz, ab = hit_vertices[first.y].xyz - a, ac = hit_vertices[first.z].xyz - a;
    vec3 n = cross(ab, ac), ap = position_ws - a;
    vec2 weights = clamp(vec2(dot(cross(ap, ac), n), dot(cross(ab, ap), n)) / dot(n, n), 0.0, 1.0);
    return Surfel(position_ws, triangle, normalize(n), 0.0, packUnorm2x16(weights / max(1.0, weights.x + weights.y)), 0u,
                  0u, 0u);
}

vec3 sent_by_triangle(Surfel s, vec3 direction_ws) {
    vec2 weights = unpackUnorm2x16(s.barycentrics);
    HitSurface side = hit_surface(s.triangle, weights.x, weights.y, direction_ws, normal_maps != 0);
    return reflected(side, s.centre_ws, s.radius, vec3(0));
}
#endif

/// By what "splats.nearest" says of the sample.
vec3 sent(uint winner, vec4 ray, ivec3 at) {
    vec3 direction_ws = ray.xyz;
#if EXACT
    if ((winner & EXACT_HIT) != 0u) {
        float distance_m = texelFetch(distances, at, 0).x;
        vec3 position_ws = texelFetch(gbuffer_position, at.xy, 0).xyz + distance_m * direction_ws;
        Surfel s = point_of(winner & ~EXACT_HIT, position_ws);
        if (BLACK_BACKS != 0 && dot(s.normal_ws, direction_ws) > 0.0) return vec3(0);
        vec3 radiance = sent_by_triangle(s, direction_ws);
#if GLOSSY_SENDERS
        radiance += sent_to_one_side(s, direction_ws, ray_slope_variance(s.triangle, distance_m, ray.w));
#endif
        return max(radiance, 0.0);
    }
#endif
    if (BLACK_BACKS != 0 && dot(surfels[winner - 1u].normal_ws, direction_ws) > 0.0) return vec3(0);
    return max(sent_by_disc(winner - 1u, ray, at), 0.0);
}

#if EXTENDED
/// What senders send of sources with an extent beyond what discs store.
uniform sampler2DArray source_light;
#endif

#if GLASS
/// Of the rays, those that glass stops send what all of them would meet of its opaque part.
float stopped_part(uint winner, vec3 direction_ws) {
    bool is_exact = (winner & EXACT_HIT) != 0u;
    uint triangle = is_exact ? winner & ~EXACT_HIT : surfels[winner - 1u].triangle;
    vec3 normal_ws = is_exact ? hit_normal(triangle) : surfels[winner - 1u].normal_ws;
    Material m = hit_materials[hit_triangle_materials[triangle]];
    return max(1.0 - passed_by_glass(m, abs(dot(normal_ws, direction_ws))), 1e-6);
}
#endif

void main() {
    ivec2 pixel = tile_pixel();
    ivec3 size = imageSize(incoming);
    if (any(greaterThanEqual(pixel, size.xy))) return;
    for (int i = 0; i < size.z; ++i) {
        ivec3 at = ivec3(pixel, i);
        uint winner = texelFetch(nearest, at, 0).x;
        vec3 radiance = vec3(0);
        if (winner != 0u) {
            vec4 ray = texelFetch(directions, at, 0);
            radiance = sent(winner, ray, at);
#if EXTENDED
            radiance += texelFetch(source_light, at, 0).rgb;
#endif
#if GLASS
            radiance /= stopped_part(winner, ray.xyz);
#endif
        }
        imageStore(incoming, at, vec4(radiance, winner != 0u ? 1 : 0));
    }
}
