// Stores linear depth: a perspective map's own depth would spend nearly all of its values beside the light.

#if MASKED
#include "lib/coverage.glsl"
#endif

layout(location = 0) in float depth;
#if MASKED
layout(location = 1) in vec2 uv;
layout(location = 2) flat in uint material;
#endif

void main() {
#if MASKED
    if (!is_covered(material, uv)) discard;
#endif
    gl_FragDepth = depth;
}
