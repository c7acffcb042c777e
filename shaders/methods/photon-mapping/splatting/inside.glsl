// Whether a kernel covers a texel: the same arithmetic for the splat and for the gather that explains it.
#include "methods/photon-mapping/splatting/depths.glsl"

#ifdef FACING
uniform sampler2D gbuffer_geometric_normal;
#endif

bool covers(vec3 centre_ws, vec3 n_ws, vec3 u_ws, vec3 t_ws, vec3 axes, vec3 origin, vec3 direction, float depth) {
#ifdef LINEAR_DEPTH
    vec3 to_centre = centre_ws - origin;
    float plane_depth = kernel_plane_depth(to_centre, n_ws, direction);
    vec3 offset = plane_depth * direction - to_centre;
    return inside_kernel_plane(vec2(dot(u_ws, offset), dot(t_ws, offset)) / axes.xy, plane_depth, depth, axes.z);
#else
    vec3 offset = origin + depth * direction - centre_ws;
    return inside_ellipsoid(vec3(dot(u_ws, offset), dot(t_ws, offset), dot(n_ws, offset)) / axes);
#endif
}

bool covers_texel(vec3 centre_ws, vec3 n_ws, vec3 u_ws, vec3 t_ws, vec3 axes, vec3 to_light_ws, ivec2 texel) {
#ifdef FACING
    vec3 normal = texelFetch(gbuffer_geometric_normal, divisor * texel + pixel_of_texel, 0).xyz;
    if (dot(normal, to_light_ws) <= 0.0) return false;
#endif
    vec2 middle_px = pixel_at(texel);
    return covers(centre_ws, n_ws, u_ws, t_ws, axes, pixel_ray_origin(middle_px), pixel_ray_direction(middle_px),
                  texelFetch(depths, texel, 0).x);
}
