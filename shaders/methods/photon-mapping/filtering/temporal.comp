// The estimate at the view's resolution, and with HISTORY averaged over frames.
layout(local_size_x = 16, local_size_y = 16) in;

#include "methods/photon-mapping/filtering/surface.glsl"
#include "methods/photon-mapping/filtering/unfiltered.glsl"
#ifdef HISTORY
#include "methods/photon-mapping/filtering/history.glsl"
#endif

layout(binding = 0, rgba32f) uniform writeonly image2D value_image;
layout(binding = 1, rg32f) uniform writeonly image2D direction_image;
uniform int first_row;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, first_row);
    if (any(greaterThanEqual(pixel, imageSize(value_image)))) return;
    FilterSurface p = surface_at(pixel);
    Signal s = Signal(vec4(0), vec2(0));
    if (is_surface(p)) {
        s = unfiltered(pixel, p);
#ifdef HISTORY
        // S_i = (1 - α) E_i + α S_{i-1}, as a step towards history that is 0 where both are equal
        History history = history_of(pixel, p);  // [Smal19 eq. 7.3]
        s.value += history.weight * (history.signal.value - s.value);
        s.direction += history.weight * (history.signal.direction - s.direction);
#endif
    }
    imageStore(value_image, pixel, s.value);
    imageStore(direction_image, pixel, vec4(s.direction, 0, 0));
}
