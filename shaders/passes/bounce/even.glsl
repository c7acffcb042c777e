// Light without materials, which a filter may average over textures. Include passes/bounce/filter.glsl before it.

#if LIGHT
#include "lib/bsdf.glsl"

uniform float min_reflectance;

/// By which light is divided before the filter and multiplied behind it.
vec3 divisor_of(Target target) { return max(albedo_of(target.scatterer, NO_GLASS), min_reflectance); }
#else
float divisor_of(Target target) { return 1.0; }
#endif
