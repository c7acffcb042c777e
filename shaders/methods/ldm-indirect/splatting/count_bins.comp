#include "methods/ldm-indirect/splatting/seen_pixels.glsl"
#include "passes/photons/count_bins.glsl"
