// What rays hit: photons that are to be stored, and the next scattering.
layout(local_size_x = 64) in;

#define TALLIES
#include "lib/glass.glsl"
#include "methods/photon-mapping/culling.glsl"
#include "methods/photon-mapping/tracing/path.glsl"
#include "methods/photon-mapping/tracing/tally.glsl"
#include "passes/scene/hit_surface.glsl"

layout(std430) readonly buffer Hits { RayHit hits[]; };
layout(std430) writeonly buffer Landed { Photon landed[]; };
layout(std430) writeonly buffer Flags { uint is_stored[]; };
layout(std430) writeonly buffer Bases { uint bases[]; };
layout(std430) readonly buffer StoredCount { uint stored_count; };

uniform uint surface_number, last_surface;  // along the path, mirrors and glass included; from 1
uniform uint min_bounces, max_bounces, max_mirrors;
uniform bool keeps_mirrored;  // light that only mirrors and clear glass have sent on, in no shadow map and no light sample
uniform bool normal_maps;
uniform bool culling;
uniform mat4 frustum_sides;
uniform vec4 eye_ws;
uniform float kernel_reach, texel_reach;

#ifdef WEIGHS
layout(std430) readonly buffer Samples { SamplePoint samples[]; };
layout(std430) buffer Sums { int sums[]; };  // for each texel of the light images

uniform uint repeats;  // photons that leave a sample point
uniform int map_resolution, seen_gain;
uniform bool seen_by_picture;
uniform mat4 pixel_from_world;
uniform float parallel_tolerance;  // m
uniform sampler2D gbuffer_position;

/// Whether the picture shows something else before the place, or does not show the place.
/// DEVIATION [Smal19 §5.4.1]: printed is the frustum alone, which holds much that walls hide.
bool is_hidden(vec3 position_ws) {
    vec4 pixel = pixel_from_world * vec4(position_ws, 1);
    if (pixel.w <= 0.0) return true;  // behind the eye; its kernel may reach before it
    ivec2 place = ivec2(floor(pixel.xy / pixel.w));
    if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, textureSize(gbuffer_position, 0)))) return true;
    vec4 surface = texelFetch(gbuffer_position, place, 0);
    if (surface.w == 0.0) return false;
    return eye_ws.w > 0.0
               ? distance(eye_ws.xyz, position_ws) > (1.0 + DEPTH_TOLERANCE) * distance(eye_ws.xyz, surface.xyz)
               : dot(eye_ws.xyz, surface.xyz - position_ws) > parallel_tolerance;
}

/// The texel that the photon came from learns whether it was worth it.  [Smal19 §5.4.1]
void count_seen(uint index, uint bounce, vec3 position_ws, bool is_seen) {
    if (is_seen && seen_by_picture) is_seen = !is_hidden(position_ws);
    if (is_seen) count(bounce, TALLY_SEEN);
    uint origin = samples[index / repeats].origin;
    if (origin == NO_TEXEL) return;
    ivec3 texel = ivec3(origin & 1023u, origin >> 10u & 1023u, origin >> 20u & 63u);
    atomicAdd(sums[(texel.z * map_resolution + texel.y) * map_resolution + texel.x], is_seen ? seen_gain : -1);
}
#else
void count_seen(uint index, uint bounce, vec3 position_ws, bool is_seen) {}
#endif

Photon photon_at(HitSurface surface, Path path, Ray ray) {
    bool normal_below, direction_below;
    Photon photon;
    photon.position_ws = surface.position_ws;
    photon.power = packed_power(power_of(path));
    photon.normal = packed_stereographic(surface.geometric_normal_ws, normal_below);
    photon.direction = packed_stereographic(-ray.direction_ws, direction_below);
    photon.ray_length = path.distance;
    photon.bits = uint(normal_below) | uint(direction_below) << 1u | scatterings_of(path) << 2u |
                  (path.bits >> 8u & 63u) << 6u | path.seed << 12u;
    return photon;
}

void store(uint index, Photon photon) {
    count_power(bounce_of(photon), unpacked_power(photon.power));
    CullingView view = CullingView(frustum_sides, eye_ws, kernel_reach, texel_reach);
    bool is_seen =
        !is_outside(view, photon.position_ws) && !faces_away(view, photon.position_ws, normal_of(photon));
    count_seen(index, bounce_of(photon), photon.position_ws, is_seen);
    if (culling && !is_seen) {
        count(bounce_of(photon), TALLY_CULLED);
        return;
    }
    count(bounce_of(photon), TALLY_STORED);
    landed[index] = photon;
    is_stored[index] = 1u;
}

/// Shading normals send some light from sample points into the surface that they lie on: its plane holds the
/// ray's origin.
bool is_own_surface(HitSurface surface, Path path, vec3 origin_ws) {
    if (surface_number > 1u || scatterings_of(path) == 0u) return false;
    return abs(dot(surface.geometric_normal_ws, origin_ws - surface.position_ws)) < 2.0 * ray_offset(origin_ws);
}

Glass glass_of(HitSurface surface) {
    if (materials == SCATTERING_LAMBERT) return NO_GLASS;
    return make_glass(surface.transmission * (1.0 - surface.metallic), surface.ior,
                      hit_materials[surface.material].thickness, surface.base_colour, surface.is_front);
}

/// What the medium leaves of the light on its way here. A surface that is seen from inside by light that has not come
/// in: it started there.
void absorb(inout Path path, HitSurface surface, Glass glass, float distance) {
    uint medium = path.medium == NO_MEDIUM && !surface.is_front && glass.part > 0.0 ? surface.material : path.medium;
    if (medium != NO_MEDIUM) set_power(path, power_of(path) * transmittance(hit_materials[medium], distance));
}

Ray go_on(inout Path path, HitSurface surface, Glass glass, vec3 from_ws) {
    uint bounce = scatterings_of(path);
    if (surface.is_unlit) {
        count(bounce, TALLY_ABSORBED);
        return no_ray();
    }
    Scatterer scatterer =
        make_scatterer(surface.shading_normal_ws, surface.geometric_normal_ws, surface.base_colour,
                       surface.metallic, surface.roughness, surface.ior, materials);
    if (bounce >= max_bounces && !has_specular(scatterer, glass)) return no_ray();
    uvec4 words = random_words(path, surface_number, DIRECTION);
    Scattered scattered =
        scatter_photon(scatterer, glass, from_ws, unit_float(words.x), unit_float(words.yz), microfacet_sampling);
    if (bounce >= max_bounces && !scattered.is_specular) return no_ray();
    if (!(glass.is_sheet && scattered.is_specular && scattered.is_transmitted)) path.bits &= ~IS_SAMPLED;
    if (!scatter_path(path, scattered, power_of(path), surface_number, unit_float(words.w))) {
        count(bounce, TALLY_ABSORBED);
        return no_ray();
    }
    if (surface_number == last_surface || mirrors_of(path) > max_mirrors) {
        count(bounce, TALLY_CUT);
        return no_ray();
    }
    float side = scattered.is_transmitted ? -1.0 : 1.0;
    if (scattered.is_transmitted && !glass.is_sheet) path.medium = surface.is_front ? surface.material : NO_MEDIUM;
    vec3 origin_ws =
        surface.position_ws + side * ray_offset(surface.position_ws) * surface.geometric_normal_ws;
    return Ray(origin_ws, far_of(path), scattered.direction_ws, 0.0);
}

void land(uint index) {
    is_stored[index] = 0u;
    Ray ray = rays[index];
    if (ray.far <= 0.0) return;
    rays[index].far = 0.0;
    Path path = paths[index];
    uint bounce = scatterings_of(path);
    count(bounce, TALLY_RAYS);
    RayHit hit = hits[index];
    if (!is_hit(hit)) {
        count(bounce, TALLY_MISSED);
        count_seen(index, bounce, vec3(0), false);
        return;
    }
    HitSurface surface = hit_surface(hit.triangle, hit.u, hit.v, ray.direction_ws, normal_maps);
    if (is_own_surface(surface, path, ray.origin_ws)) {
        count(bounce, TALLY_ABSORBED);
        return;
    }
    Glass glass = glass_of(surface);
    absorb(path, surface, glass, hit.distance);
    bool is_from_light = bounce == 0u && mirrors_of(path) == 0u;
    if (!is_from_light) path.distance += hit.distance;
    bool is_mirrored = !is_from_light && (path.bits & IS_SAMPLED) == 0u;
    bool counts = bounce == 0u ? keeps_mirrored && is_mirrored : bounce >= min_bounces;
    if (counts && glass.part <= MOSTLY_GLASS) store(index, photon_at(surface, path, ray));
    rays[index] = go_on(path, surface, glass, -ray.direction_ws);
    paths[index] = path;
}

void main() {
    begin_tally();
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index == 0u) bases[surface_number] = stored_count;  // of the surfaces before
    if (index < end_item) land(index);
    end_tally();
}
