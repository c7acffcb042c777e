// Which pixels a photon may light.
#include "methods/ldm-indirect/splatting/outline.glsl"

layout(std430) readonly buffer Photons { Photon photons[]; };

bool seen_pixels(uint photon, out uvec4 pixels) {
    pixels = uvec4(0);
    Footprint f = footprint_of(photons[photon]);
    if (!f.counts) return false;
    Outline o = outline_of(f);
    if (!is_in_view(o)) return false;
    pixels = uvec4(pixels_of(o));
    return true;
}
