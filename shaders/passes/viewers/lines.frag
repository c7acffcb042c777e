// A band that is darker at its sides where it is wide enough.
#include "passes/viewers/put.glsl"

uniform uint layer_number;
uniform float line_px;

layout(location = 0) flat in vec3 colour;
layout(location = 1) flat in uint element;
layout(location = 2) noperspective in float across;

void main() {
    float from_side_px = 0.5 * line_px * (1.0 - abs(across));
    float rim = line_px >= 3.0 ? 1.0 - smoothstep(0.25, 1.25, from_side_px) : 0.0;
    put(colour * mix(1.0, 0.4, rim), layer_number, element, gl_FragCoord.z);
}
