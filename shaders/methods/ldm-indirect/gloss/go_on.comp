// Takes the light of what each pixel's ray met, and draws where its path goes on. After the last event the path is
// added to the picture, and after the last sample, with PROGRESSIVE, the picture to the frames before.
layout(local_size_x = 64) in;

#include "methods/ldm-indirect/gloss/path.glsl"
#include "passes/direct/device/hit_scatterer.glsl"

layout(std430) buffer Rays { Ray rays[]; };
layout(std430) readonly buffer Hits { RayHit hits[]; };
layout(std430) buffer Paths { Path paths[]; };
layout(std430) buffer GroupLight { vec4 group_light[]; };

layout(rgba32f) uniform image2D radiance_image;
layout(r32f) uniform writeonly image2D distance_image;
uniform sampler2D radiance_before;

uniform uint event, events, samples, max_bounces;
uniform bool continues;  // what was before

Ray go_on(inout Path path, inout float spread, ivec2 pixel, Ray ray, RayHit hit, vec3 light) {
    if (!(ray.far > 0.0) || !is_hit(hit)) return no_ray();
    HitSurface met = hit_surface(hit.triangle, hit.u, hit.v, ray.direction_ws, normal_maps);
    SeenSurface surface = scatterer_of(met, ray.direction_ws);
    if (path.scatterings > 0u || is_whole)
        path.light += path.throughput * (surface.exists ? light : path.scatterings > 0u ? vec3(0) : met.base_colour);
    if (!surface.exists) return no_ray();
    Scattered next = scattered_at(surface.scatterer, surface.glass, surface.wo, pixel, event + 1u);
    if (next.weight == vec3(0) || next.is_transmitted) return no_ray();
    spread += spread_of(next, surface.scatterer, surface.glass, surface.wo);
    path.throughput *= next.weight;
    path.scatterings += next.is_specular ? 0u : 1u;
    if (path.scatterings > max_bounces) return no_ray();
    return ray_from(surface.position_ws, surface.geometric_n, next.direction_ws);
}

void add(ivec2 pixel, vec3 light) {
    vec4 sum = vec4(light, 1);
    if (number > 0u) sum.rgb += imageLoad(radiance_image, pixel).rgb;
    if (number + 1u == samples) {
        sum.rgb /= float(samples);
#ifdef PROGRESSIVE
        vec4 before = texelFetch(radiance_before, pixel, 0);
        if (continues) sum = vec4((before.a * before.rgb + sum.rgb) / (before.a + 1.0), before.a + 1.0);
#endif
    }
    imageStore(radiance_image, pixel, sum);
}

void main() {
    uint place = gl_GlobalInvocationID.x;
    ivec2 pixel;
    if (!pixel_of(place, pixel)) return;
    Path path = paths[place];
    Ray ray = rays[ray_of_hit(place)];
    RayHit hit = hits[ray_of_hit(place)];
    if (event == 0u && number == 0u)
        imageStore(distance_image, pixel, vec4(ray.far > 0.0 && is_hit(hit) ? hit.distance : 0.0));
    float spread = abs(spreads[place]);
    rays[ray_of_hit(place)] = go_on(path, spread, pixel, ray, hit, group_light[place].rgb);
    spreads[place] = signed_spread(path, spread);
    paths[place] = path;
    group_light[place] = vec4(0);
    if (event + 1u == events) add(pixel, path.light);
}
