#include "methods/photon-mapping/splatting/seen_pixels.glsl"
#include "passes/photons/fill_bins.glsl"
