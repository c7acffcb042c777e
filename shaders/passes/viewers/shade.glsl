// Light that comes from over the viewer's shoulder.

uniform vec3 shade_eye_ws, shade_axis_ws, shade_light_ws;  // axis: of view; light: unit vector towards it
uniform bool shade_orthographic;

// The normal, turned to the viewer.
vec3 turned(vec3 normal_ws, vec3 position_ws) {
    vec3 to_viewer = shade_orthographic ? -shade_axis_ws : shade_eye_ws - position_ws;
    return dot(normal_ws, to_viewer) < 0.0 ? -normal_ws : normal_ws;
}

// For coloured things: 1 where the light falls straight, never dark.
float light_shade(vec3 normal_ws, vec3 position_ws) {
    return 0.55 + 0.45 * max(0.0, dot(turned(normal_ws, position_ws), shade_light_ws));
}

// For the scene itself: shapes read by this alone.
float strong_shade(vec3 normal_ws, vec3 position_ws) {
    return 0.2 + 0.8 * max(0.0, dot(turned(normal_ws, position_ws), shade_light_ws));
}
