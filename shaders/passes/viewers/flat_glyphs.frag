// Lightly shaded, with a darker rim of a pixel where the glyph is large enough.
#include "passes/viewers/put.glsl"
#include "passes/viewers/shade.glsl"

uniform uint layer_number;
uniform bool round;

layout(location = 0) flat in vec3 colour;
layout(location = 1) flat in uint element;
layout(location = 2) flat in vec3 normal_ws;
layout(location = 3) in vec2 place;
layout(location = 4) in vec3 position_ws;

void main() {
    float from_centre = round ? length(place) : max(abs(place.x), abs(place.y));
    float pixel = max(fwidth(from_centre), 1e-6);
    if (round && from_centre > 1.0) discard;
    float rim = pixel < 0.25 ? smoothstep(1.0 - 1.75 * pixel, 1.0 - 0.5 * pixel, from_centre) : 0.0;
    put(colour * light_shade(normal_ws, position_ws) * mix(1.0, 0.5, rim), layer_number, element, gl_FragCoord.z);
}
