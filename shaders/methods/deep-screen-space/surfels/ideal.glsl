// The size that surfels should have: that of a disc which, seen face on, covers the same number of pixels
// everywhere. [Nalbach15 §4.1]

#include "lib/constants.glsl"

uniform vec3 ideal_eye_ws;
uniform vec3 ideal_axis_ws;         // of view, unit length; 0 for parallel rays
uniform float ideal_radius;         // m at 1 m along the axis of view; for parallel rays everywhere
uniform float ideal_corner_cosine;  // of the angle between the axis and the picture's corners
uniform float ideal_nearest;        // m: the near plane's distance

/// Along the axis of view. Points beside and behind the picture, whose surfels light or block what is in it, count
/// as far as those on the cone through the picture's corners at their distance from the eye: in the picture that
/// changes nothing, around it nothing jumps, and what is behind the eye is coarser the farther it is.
float ideal_distance(vec3 position_ws) {
    vec3 offset = position_ws - ideal_eye_ws;
    return max(max(dot(offset, ideal_axis_ws), ideal_corner_cosine * length(offset)), ideal_nearest);
}

float ideal_area_at(float distance) {
    float radius = ideal_radius * (ideal_axis_ws == vec3(0) ? 1.0 : distance);
    return PI * radius * radius;
}

/// A* in m²
float ideal_area(vec3 position_ws) { return ideal_area_at(ideal_distance(position_ws)); }
