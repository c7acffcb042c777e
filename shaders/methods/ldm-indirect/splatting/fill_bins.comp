#include "methods/ldm-indirect/splatting/seen_pixels.glsl"
#include "passes/photons/fill_bins.glsl"
