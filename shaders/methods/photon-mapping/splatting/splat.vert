// One instance a photon. The ellipsoid is drawn as an icosahedron around it, of which one side is seen; the
// plane as a square around its ellipse.  [Smal19 eq. 6.4]
#include "methods/photon-mapping/splatting/photon_kernel.glsl"

layout(std430) readonly buffer Icosahedron { float icosahedron[]; };  // xyz of unit vertices

uniform uint first;

layout(location = 0) flat out vec4 add_irradiance;
layout(location = 1) flat out vec2 add_direction;
layout(location = 2) flat out vec3 centre_ws;
layout(location = 3) flat out vec3 n_ws;
layout(location = 4) flat out vec3 u_ws;
layout(location = 5) flat out vec3 t_ws;
layout(location = 6) flat out vec3 axes;
layout(location = 7) flat out vec3 to_light_ws;

// With its vertices at this distance the faces touch the unit sphere from outside. One hundredth more keeps
// rounded corners and depths from cutting it.
// DEVIATION [Smal19 §6.2]: with its vertices on the ellipsoid the icosahedron covers 76 % of it.
#ifndef ICOSAHEDRON_SCALE
#define ICOSAHEDRON_SCALE (1.01 * 1.2584086)  // √(15 - 6 √5)
#endif

const vec4 nowhere = vec4(2, 2, 0, 1);

vec4 corner_of_ellipsoid(Kernel k) {
    vec3 vertex = ICOSAHEDRON_SCALE * vec3(icosahedron[3 * gl_VertexID], icosahedron[3 * gl_VertexID + 1],
                                           icosahedron[3 * gl_VertexID + 2]);
    vec3 to_eye = eye_ws - k.centre_ws;
    vec3 eye_ks = vec3(dot(k.u_ws, to_eye), dot(k.t_ws, to_eye), dot(k.n_ws, to_eye)) / k.axes;
    bool from_inside = perspective && length(eye_ks) < 1.05 * ICOSAHEDRON_SCALE;
    // The solid's mirror image in its middle is itself, with faces turned inside out.
    if (from_inside) vertex = -vertex;
    vertex *= k.axes;
    vec4 place = place_in_picture(k.centre_ws + vertex.x * k.u_ws + vertex.y * k.t_ws + vertex.z * k.n_ws);
    if (from_inside) place.z = place.w;  // before all surfaces
    return place;
}

const float SQUARE_SCALE = 1.01;

/// Moved towards the viewer by the half-thickness, so that surfaces in front of the kernel hide it. All of a square
/// that comes before the near plane is before all surfaces: depths between its corners would be wrong there.
vec4 corner_of_plane(Kernel k) {
    vec2 corner = (2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0) * k.axes.xy;
    vec3 position_ws = k.centre_ws + SQUARE_SCALE * (corner.x * k.u_ws + corner.y * k.t_ws);
    vec4 place = place_in_picture(position_ws);
    vec2 reach = abs(vec2(dot(k.u_ws, view_axis_ws), dot(k.t_ws, view_axis_ws)));
    float nearest = view_depth(k.centre_ws) - SQUARE_SCALE * (dot(reach, k.axes.xy) + k.axes.z);
    place.z = perspective && nearest < near_plane
                  ? abs(place.w)
                  : reversed_depth(view_depth(position_ws) - SQUARE_SCALE * k.axes.z) * place.w;
    return place;
}

void main() {
    Photon photon = photons[first + uint(gl_InstanceID)];
    gl_Position = nowhere;
    if (!is_splatted(photon)) return;
    Kernel k = kernel_of(photon);
#ifdef LINEAR_DEPTH
    gl_Position = corner_of_plane(k);
#else
    gl_Position = corner_of_ellipsoid(k);
#endif
    to_light_ws = direction_of(photon);
    vec3 weighted = dot(k.irradiance, vec3(1)) * to_light_ws;
    add_irradiance = vec4(k.irradiance, weighted.x);
    add_direction = weighted.yz;
    centre_ws = k.centre_ws;
    n_ws = k.n_ws;
    u_ws = k.u_ws;
    t_ws = k.t_ws;
    axes = k.axes;
}
