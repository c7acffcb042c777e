#include "methods/photon-mapping/splatting/seen_pixels.glsl"
#include "passes/photons/count_bins.glsl"
