#include "passes/ldm/sky.glsl"
