// How many splats of each surfel are drawn for a sample, and how many culled.
layout(local_size_x = 64) in;

#include "lib/floats.glsl"
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/drawn_splat.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) readonly buffer Stored { uint stored, made; };
/// As fields of "splats.by_surfel".
// C++: ir::methods::deep_screen_space::CulledSplats
struct CulledSplats {
    float centre[3], normal[3], radius;
    uint surfel, drawn, culled;
};
layout(std430) writeonly buffer Shown { CulledSplats shown[]; };
layout(std430) writeonly buffer ShownCount { uint shown_count; };

uniform uint first_item, end_item;
uniform int levels;

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i == 0u) shown_count = stored;
    if (i >= min(end_item, stored) || i >= uint(shown.length())) return;
    Surfel s = surfels[i];
    CulledSplats c = CulledSplats(floats(s.centre_ws), floats(s.normal_ws), s.radius, i + 1u, 0u, 0u);
    for (int level = 0; level < levels; ++level) {
        int fate = drawn_splat(s, i, level).fate;
        c.drawn += fate == SPLAT_DRAWN ? 1u : 0u;
        c.culled += fate == SPLAT_CULLED ? 1u : 0u;
    }
    shown[i] = c;
}
