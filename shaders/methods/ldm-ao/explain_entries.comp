// Walks through a map from the pixel's point. [Aalund15 §3.1, Fig. 4]
layout(local_size_x = 1) in;
#include "methods/ldm-ao/explained.glsl"
#include "passes/ldm/walk.glsl"

uniform uint map_among_all, map_of_batch;

void main() {
    Surface x = explained_surface();
    if (!x.exists) return;
    frame_index = map_among_all;
    map = map_of_batch;
    walk_from(x.position, x.normal, x.geometric_normal);
}
