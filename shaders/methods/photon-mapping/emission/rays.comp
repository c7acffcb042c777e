// A ray from a light for each point of the emission sets.  [Smal19 §4.2]
layout(local_size_x = 64) in;
#include "methods/photon-mapping/emission/light_rays.glsl"
#include "passes/raytracing/rays.glsl"

layout(std430) writeonly buffer Rays { Ray rays[]; };

void main() {
    uint item = first_item + gl_GlobalInvocationID.x;
    if (item >= end_item) return;
    uint index = source_of_item(item);
    Source source = sources[index];
    Light light = lights[source.light];
    vec2 u = emission_point(emission_set_of(index), item - source.first_point);
    Ray ray = no_ray();
    ray.far = light.range > 0.0 && source.perspective != 0.0 ? light.range : RAY_INFINITY;
    if (source.perspective != 0.0) {
        ray.origin_ws = source.origin_ws;
        ray.direction_ws =
            direction_in_cone(light.direction_ws, light.type == LIGHT_SPOT ? light.cos_outer : -1.0, u);
    } else {
        ray.origin_ws = place_on_disc(source.origin_ws, light.direction_ws, bounds_radius, u);
        ray.direction_ws = light.direction_ws;
    }
    rays[item] = ray;
}
