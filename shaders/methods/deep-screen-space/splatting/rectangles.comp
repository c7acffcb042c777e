// Finds the rectangle of places that each surfel can affect on one level for one sample, and writes the command
// that draws them.  [Nalbach15 §4.1]
// DARK_IS_IDLE: surfels that send no light are not drawn.
layout(local_size_x = 64) in;

#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/influence.glsl"
#include "methods/deep-screen-space/splatting/sphere_bounds.glsl"
#include "methods/deep-screen-space/splatting/splat_culling.glsl"
#include "methods/deep-screen-space/splatting/sub_image.glsl"

layout(std430) readonly buffer Stored { uint stored, made; };
layout(std430) readonly buffer Surfels { Surfel surfels[]; };
#if DARK_IS_IDLE
layout(std430) readonly buffer SurfelLights { SurfelLight surfel_lights[]; };
#endif
layout(std430) writeonly buffer Rectangles { uvec2 rectangles[]; };
layout(std430) writeonly buffer Draw { uint vertices, instances, first_vertex, base_instance; };
#ifdef COUNTS
layout(std430) buffer Drawn { uint drawn; };
layout(std430) buffer Culled { uint culled; };
#endif

uniform uint first, end;  // surfels
uniform uint level, sample_index, seed;
uniform ivec2 hierarchy_size;
uniform bool culls, shells;

shared uint group_drawn, group_culled;

// DEVIATION [Nalbach14]: "depending on the estimated influence" [Nalbach15 §4.1] leaves open which; there it also
// depends on the radiance that is sent, which here only counts as none or some, as ε would else depend on exposure.
bool is_idle(uint surfel) {
#if DARK_IS_IDLE
    SurfelLight light = surfel_lights[surfel];
    return light_of_side(light, true) == vec3(0) && light_of_side(light, false) == vec3(0);
#else
    return false;
#endif
}

/// First place, and the one after the last; both 0: none.
uvec2 rectangle_of(Surfel surfel) {
    if (surfel.radius == 0.0) return uvec2(0);  // there is a hole
    Shell shell = shell_of(surfel, int(level));
    if (shell.inner >= shell.outer) return uvec2(0);
    float reach = shell.outer, inner = shells ? shell.inner : 0.0;
    PixelRange range = pixels_of_sphere(surfel.centre_ws, reach);
    if (any(lessThan(range.last, range.first))) return uvec2(0);
    if (culls && !is_range_reached(range.first, range.last, surfel.centre_ws, reach, inner)) {
        atomicAdd(group_culled, 1u);
        return uvec2(0);
    }
    atomicAdd(group_drawn, 1u);
    uvec2 corner = random_sub_image(surfel, level, sample_index, seed) * (uvec2(hierarchy_size) >> level);
    uvec2 begin = corner + (uvec2(range.first) >> level), after = corner + (uvec2(range.last) >> level) + 1u;
    return uvec2(begin.x | begin.y << 16, after.x | after.y << 16);
}

void main() {
    if (gl_LocalInvocationIndex == 0u) group_drawn = group_culled = 0u;
    barrier();
    uint i = first + gl_GlobalInvocationID.x, last = min(end, stored);
    if (gl_GlobalInvocationID.x == 0u) {
        vertices = 6u * (last - min(first, last));
        instances = 1u;
        first_vertex = base_instance = 0u;
    }
    if (i < last) rectangles[i - first] = is_idle(i) ? uvec2(0) : rectangle_of(surfels[i]);
#ifdef COUNTS
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        if (group_drawn > 0u) atomicAdd(drawn, group_drawn);
        if (group_culled > 0u) atomicAdd(culled, group_culled);
    }
#endif
}
