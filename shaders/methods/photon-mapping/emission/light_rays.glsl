// Rays from lights, evenly over where they shine to.

#include "lib/constants.glsl"
#include "lib/light.glsl"
#include "lib/spaces.glsl"
#include "methods/photon-mapping/records.glsl"

layout(std430) readonly buffer Sources { Source sources[]; };
layout(std430) readonly buffer Lights { Light lights[]; };
#include "methods/photon-mapping/emission/sources.glsl"

uniform uint first_item, end_item;
uniform float bounds_radius;  // m

const float TWO_PI = 2.0 * PI;

/// Where a source's rays go to: sr, or m² of a directional light.
float extent_of(Light light) {
    if (light.type == LIGHT_DIRECTIONAL) return 0.5 * TWO_PI * bounds_radius * bounds_radius;
    return TWO_PI * (1.0 - (light.type == LIGHT_SPOT ? light.cos_outer : -1.0));
}

/// Unit direction whose cosine to the axis is even in [min_cosine, 1].
vec3 direction_in_cone(vec3 axis, float min_cosine, vec2 u) {
    float height = u.x * (1.0 - min_cosine), cosine = 1.0 - height;
    float sine = sqrt(max(height * (2.0 - height), 0.0)), angle = TWO_PI * u.y;
    return normalize(frame_around(axis) * vec3(sine * cos(angle), sine * sin(angle), cosine));
}

vec3 place_on_disc(vec3 centre, vec3 axis, float radius, vec2 u) {
    float angle = TWO_PI * u.y, r = radius * sqrt(u.x);
    return centre + frame_around(axis) * vec3(r * cos(angle), r * sin(angle), 0);
}
