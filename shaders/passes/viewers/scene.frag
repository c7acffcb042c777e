#include "passes/viewers/shade.glsl"

layout(location = 0) in vec3 position_ws;
layout(location = 0) out vec4 out_colour;
layout(location = 1) out uvec2 out_id;

const vec3 front = vec3(0.42), back = vec3(0.45, 0.35, 0.30);

void main() {
    vec3 across = cross(dFdx(position_ws), dFdy(position_ws));
    float size = length(across);
    vec3 normal_ws = size > 0.0 ? across / size : shade_light_ws;
    vec3 to_viewer = normalize(shade_orthographic ? -shade_axis_ws : shade_eye_ws - position_ws);
    // not where it grazes: there the backs of closed things peep out behind their edges
    float away = gl_FrontFacing ? 0.0 : smoothstep(0.1, 0.4, abs(dot(normal_ws, to_viewer)));
    out_colour = vec4(mix(front, back, away) * strong_shade(normal_ws, position_ws), 1);
    out_id = uvec2(0);
}
