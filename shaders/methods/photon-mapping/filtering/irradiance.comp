// The final irradiance; with FLICKER how far apart the directions are from which it comes.
layout(local_size_x = 16, local_size_y = 16) in;

#include "passes/reflection/directional.glsl"

#ifdef FLICKER
layout(r32f) uniform writeonly image2D result;
#else
layout(rgba32f) uniform writeonly image2D result;
#endif
uniform int first_row;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, first_row);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
#ifdef FLICKER
    imageStore(result, pixel, vec4(1.0 - coherence(pixel)));
#else
    imageStore(result, pixel, vec4(shaded_irradiance(pixel), 1));
#endif
}
