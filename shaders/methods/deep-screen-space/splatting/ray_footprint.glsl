// What of a sender one ray stands for.
#include "passes/scene/highlights.glsl"

uniform float highlight_share;  // of the solid angle 1 / density; 0: rays stand for points

/// DEVIATION [Nalbach15 §3.2]: a ray shows what its one direction has.
float ray_slope_variance(uint triangle, float distance_m, float density) {
    if (highlight_share == 0.0) return 0.0;
    return slope_variance(triangle, distance_m, highlight_share / density);
}
