// The shadow map at the RSM's resolution.  [Smal19 §5.1]

#include "passes/rsm/texel.glsl"

void main() {
    if (!texel_is_covered()) discard;
    gl_FragDepth = texel_depth();
}
