// How much of a pixel is history (VIEW_WEIGHT), and how much of that the present does not explain.
layout(local_size_x = 16, local_size_y = 16) in;

#include "passes/a_trous/surface.glsl"
#include "methods/photon-mapping/filtering/unfiltered.glsl"
#include "methods/photon-mapping/filtering/history.glsl"
#include "methods/photon-mapping/filtering/ghosting.glsl"

layout(r32f) uniform writeonly image2D view;
uniform int first_row;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, first_row);
    if (any(greaterThanEqual(pixel, imageSize(view)))) return;
    FilterSurface p = surface_at(pixel);
    float result = 0.0;
    if (is_surface(p)) {
        History history = history_of(pixel, p);
#ifdef VIEW_WEIGHT
        result = history.weight;
#else
        result = history.weight > 0.0 ? ghosting(pixel, p, history) : 0.0;
#endif
    }
    imageStore(view, pixel, vec4(result));
}
