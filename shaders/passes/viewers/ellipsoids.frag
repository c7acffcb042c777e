// The ray through the pixel meets the ellipsoid as a unit sphere.
#include "lib/pixel_rays.glsl"
#include "passes/viewers/put.glsl"
#include "passes/viewers/shade.glsl"

uniform uint layer_number;
uniform mat4 clip_from_world;

layout(location = 0) flat in vec3 colour;
layout(location = 1) flat in uint element;
layout(location = 2) flat in vec3 centre_ws;
layout(location = 3) flat in vec3 row_0;
layout(location = 4) flat in vec3 row_1;
layout(location = 5) flat in vec3 row_2;

vec3 to_sphere(vec3 v) { return vec3(dot(row_0, v), dot(row_1, v), dot(row_2, v)); }

void main() {
    vec3 origin = pixel_ray_origin(gl_FragCoord.xy), ray = pixel_ray_direction(gl_FragCoord.xy);
    vec3 o = to_sphere(origin - centre_ws), d = to_sphere(ray);
    // the nearest point of the ray to the centre first: no cancellation where the eye is far away
    float dd = dot(d, d), middle = -dot(o, d) / dd;
    vec3 nearest = o + middle * d;
    float inside = 1.0 - dot(nearest, nearest);
    if (inside < 0.0) discard;
    float half_chord = sqrt(inside / dd);
    float t = middle - half_chord;
    if (t <= 0.0) t = middle + half_chord;  // from within
    if (t <= 0.0) discard;
    vec3 on_sphere = o + t * d, hit_ws = origin + t * ray;
    vec3 normal_ws = normalize(row_0 * on_sphere.x + row_1 * on_sphere.y + row_2 * on_sphere.z);
    vec4 clip = clip_from_world * vec4(hit_ws, 1);
    gl_FragDepth = clamp(clip.z / clip.w, 0.0, 1.0);
    float rim = 1.0 - smoothstep(0.05, 0.3, abs(dot(normal_ws, normalize(ray))));
    put(colour * light_shade(normal_ws, hit_ws) * mix(1.0, 0.6, rim), layer_number, element, gl_FragDepth);
}
