// Draws a ray from the surface that each pixel's ray met towards one light without extent: HitLight::of_punctual().
layout(local_size_x = 64) in;

#include "lib/floats.glsl"
#include "lib/light.glsl"
#include "passes/direct/device/hit_scatterer.glsl"

layout(std430) buffer Rays { Ray rays[]; };
layout(std430) readonly buffer Hits { RayHit hits[]; };
layout(std430) writeonly buffer LightPaths { LightPath light_paths[]; };
layout(std430) readonly buffer Lights { Light lights[]; };

uniform uint light;    // of the scene's
uniform bool any_hit;  // nothing lets light through

Ray towards(Light from, SeenSurface surface, out vec3 radiance) {
    radiance = vec3(0);
    PunctualArrival arrival = punctual_arrival(from, surface.position_ws);
    if (arrival.irradiance == vec3(0) || dot(surface.geometric_n, arrival.direction_ws) <= 0.0) return no_ray();
    SeenScatterer seen = seen_from(surface.scatterer, surface.wo);
    radiance =
        evaluate_with_pdf(surface.scatterer, surface.glass, seen, arrival.direction_ws).value * arrival.irradiance;
    if (radiance == vec3(0) || !is_finite(radiance)) return no_ray();
    float far = from.type == LIGHT_DIRECTIONAL ? RAY_INFINITY
                                               : SHADOW_RAY_END * distance(from.position_ws, surface.position_ws);
    return Ray(offset_origin(surface.position_ws, surface.geometric_n), far, arrival.direction_ws, any_hit ? 1.0 : 0.0);
}

void main() {
    uint place = gl_GlobalInvocationID.x;
    ivec2 pixel;
    if (!pixel_of(place, pixel)) return;
    SeenSurface surface = surface_of_hit(rays[ray_of_hit(place)], hits[ray_of_hit(place)], spreads[place], false);
    Ray ray = no_ray();
    vec3 radiance = vec3(0);
    if (surface.exists) ray = towards(lights[light], surface, radiance);
    rays[place] = ray;
    light_paths[place] = LightPath(radiance, 0.0);
    rays[direction_ray(place)] = no_ray();
}
