// The estimate at the view's resolution, and with HISTORY averaged over frames.
layout(local_size_x = 16, local_size_y = 16) in;

#include "passes/a_trous/surface.glsl"
#include "methods/photon-mapping/filtering/unfiltered.glsl"
#ifdef HISTORY
#include "methods/photon-mapping/filtering/history.glsl"
#ifdef REJECTS_GHOSTS
#include "methods/photon-mapping/filtering/ghosting.glsl"
#endif
layout(r32f) uniform writeonly image2D length_image;
#endif

layout(rgba32f) uniform writeonly image2D value_image;
layout(rg32f) uniform writeonly image2D direction_image;
layout(std430) buffer Overflow { uint overflow; };
uniform int first_row;

/// Half floats end at 65504: drivers stop there or go on with infinity, which would stay in the history.
Signal finite(Signal s) {
    vec4 most = max(abs(s.value), vec4(abs(s.direction), 0, 0));
    bool is_bad = any(isinf(most)) || any(isnan(s.value)) || any(isnan(s.direction));
#ifdef HALF_SUMS
    is_bad = is_bad || any(greaterThanEqual(most, vec4(65504.0)));
#endif
    if (!is_bad) return s;
    atomicAdd(overflow, 1u);
    for (int i = 0; i < 3; ++i) s.value[i] = isnan(s.value[i]) ? 0.0 : min(s.value[i], 65504.0);
    return Signal(vec4(s.value.rgb, 0), vec2(0));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, first_row);
    if (any(greaterThanEqual(pixel, imageSize(value_image)))) return;
    FilterSurface p = surface_at(pixel);
    Signal s = Signal(vec4(0), vec2(0));
    float frames = 0.0;
    if (is_surface(p)) {
        s = finite(unfiltered(pixel, p));
#ifdef HISTORY
        // S_i = (1 - α) E_i + α S_{i-1}, as a step towards history that is 0 where both are equal
        History history = history_of(pixel, p);  // [Smal19 eq. 7.3]
#ifdef REJECTS_GHOSTS
        if (history.weight > 0.0) without_ghosts(pixel, p, history);
#endif
        s.value += history.weight * (history.signal.value - s.value);
        s.direction += history.weight * (history.signal.direction - s.direction);
        frames = history.length + 1.0;
#endif
    }
    imageStore(value_image, pixel, s.value);
    imageStore(direction_image, pixel, vec4(s.direction, 0, 0));
#ifdef HISTORY
    imageStore(length_image, pixel, vec4(frames));
#endif
}
