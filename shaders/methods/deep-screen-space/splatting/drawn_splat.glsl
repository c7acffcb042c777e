// Whether the splat of a surfel on a level is drawn, and where. DARK_IS_IDLE: surfels that send no light are not.
// Include records.glsl before it.
#include "methods/deep-screen-space/splatting/influence.glsl"
#include "methods/deep-screen-space/splatting/sphere_bounds.glsl"
#include "methods/deep-screen-space/splatting/splat_culling.glsl"

#if DARK_IS_IDLE
layout(std430) readonly buffer SurfelLights { SurfelLight surfel_lights[]; };
#endif

uniform bool culls, shells;

const int SPLAT_ABSENT = 0;  // nothing of its shell is in the picture
const int SPLAT_CULLED = 1;  // nothing that the picture shows there lies within its shell
const int SPLAT_DRAWN = 2;

struct DrawnSplat {
    int fate;
    PixelRange range;  // of the picture; where it is drawn
};

// DEVIATION [Nalbach14]: "depending on the estimated influence" [Nalbach15 §4.1] leaves open which; there it also
// depends on the radiance that is sent, which here only counts as none or some, as ε would else depend on exposure.
bool is_idle(uint surfel) {
#if DARK_IS_IDLE
    return is_dark(surfel_lights[surfel]);
#else
    return false;
#endif
}

DrawnSplat drawn_splat(Surfel surfel, uint index, int level) {
    DrawnSplat absent = DrawnSplat(SPLAT_ABSENT, NO_PIXELS);
    if (surfel.radius == 0.0 || is_idle(index)) return absent;  // there is a hole
    Shell shell = shell_of(surfel.radius, level);
    if (shell.inner >= shell.outer) return absent;
    PixelRange range = pixels_of_sphere(surfel.centre_ws, shell.outer);
    if (any(lessThan(range.last, range.first))) return absent;
    bool is_reached = !culls || is_range_reached(range.first, range.last, surfel.centre_ws, shell.outer,
                                                 shells ? shell.inner : 0.0);
    return DrawnSplat(is_reached ? SPLAT_DRAWN : SPLAT_CULLED, range);
}
