// The shadow map at the RSM's resolution.  [Smal19 §5.1]

#include "passes/shadow/texel.glsl"
#include "passes/rsm/cone.glsl"

void main() {
    if (is_outside_cone() || has_hole_here()) discard;
    gl_FragDepth = texel_depth();
}
