// Depth peeling, third step: sizes of the dispatches that peel the planes. One invocation: one plane.
layout(local_size_x = 64) in;
#include "passes/ldm/peel_builder.glsl"

void main() {
    uint plane = gl_GlobalInvocationID.x;
    if (3u * plane + 2u >= uint(layer_groups.length())) return;
    bool peels = plane < chunks[chunk].planes;
    layer_groups[3u * plane] = peels ? fragment_groups[0] : 0u;
    layer_groups[3u * plane + 1u] = fragment_groups[1];
    layer_groups[3u * plane + 2u] = 1u;
}
