// Σ V cosθ and Σ cosθ over all maps, of pixels of the grid. [Aalund15 eq. 2]
layout(local_size_x = 64) in;
#include "passes/ldm/effect_pixels.glsl"
#include "passes/ldm/frames.glsl"

layout(std430) readonly buffer Openness { float openness_of[]; };
/// Of each pixel both sums in turn; zeros where it shows no surface.
layout(std430) writeonly buffer EffectSums { float sums[]; };

uniform uint all_maps;

void main() {
    uint pixel = gl_GlobalInvocationID.x;
    if (pixel >= pixel_count()) return;
    EffectSurface x = surface_of(pixel);
    vec2 sum = vec2(0.0);
    for (uint map = 0u; map < all_maps && x.exists; ++map) {
        float cosine = abs(dot(x.normal, ldm_frames[map].direction.xyz));
        sum += cosine * vec2(openness_of[map * pixel_count() + pixel], 1.0);
    }
    sums[2u * pixel] = sum.x;
    sums[2u * pixel + 1u] = sum.y;
}
