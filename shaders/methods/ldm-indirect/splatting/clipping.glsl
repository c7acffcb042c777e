// Whether a place in a photon's beam is lit by it. Include kernel.glsl first.
#include "methods/ldm-indirect/looks.glsl"

layout(std430) readonly buffer Looks { uint looks[]; };

uniform float units_per_metre;
uniform uint look_maps;

/// The photon was traced, so that nothing is in the way near its sender; what is near the pixel the pixel's own look
/// along the photon's direction knows.
bool is_lit(Kernel k, ivec2 pixel, ivec2 size, vec3 position_ws) {
    if (k.distance <= 0.0) return true;
    uvec2 place = uvec2(pixel);
    uint look = bitfieldExtract(looks[look_word(place, uint(size.x), look_maps, k.map)], look_bit(place), 8);
    return look == OPEN_LOOK || unpacked_look(look) >= min_look(k, position_ws) * units_per_metre;
}
