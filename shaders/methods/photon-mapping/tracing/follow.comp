// Keeps what the rays of photons met, for views of their paths.
layout(local_size_x = 64) in;
#include "lib/floats.glsl"
#include "passes/raytracing/rays.glsl"

/// World space; not a number behind the end of a path.
// C++: ir::methods::photon_mapping::PathVertex
struct Vertex {
    float position[3];
};
layout(std430) readonly buffer Rays { Ray rays[]; };
layout(std430) readonly buffer Hits { RayHit hits[]; };
layout(std430) writeonly buffer Vertices { Vertex vertices[]; };

uniform uint first_item, end_item;  // of the paths
uniform uint surface_number;        // from 1
uniform uint vertices_of_path;

void main() {
    uint path = first_item + gl_GlobalInvocationID.x;
    if (path >= end_item) return;
    Ray ray = rays[path];
    RayHit hit = hits[path];
    bool goes_on = ray.far > 0.0;
    uint first = path * vertices_of_path;
    if (surface_number == 1u) vertices[first].position = floats(goes_on ? ray.origin_ws : NOWHERE);
    bool meets = goes_on && is_hit(hit);
    vertices[first + surface_number].position =
        floats(meets ? ray.origin_ws + hit.distance * ray.direction_ws : NOWHERE);
}
