// The shadow map at the RSM's resolution.  [Smal19 §5.1]

#include "passes/shadow/texel.glsl"

void main() {
    if (has_hole_here()) discard;
    gl_FragDepth = texel_depth();
}
