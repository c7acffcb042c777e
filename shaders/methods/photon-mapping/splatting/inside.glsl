// Whether a kernel covers a texel: the same arithmetic for the splat and for the gather that explains it.
#include "lib/pixel_rays.glsl"

uniform sampler2D surfaces;  // depth; at lower resolutions those of the closest and the farthest

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

/// At lower resolutions closest and farthest must both lie within.  [Smal19 §6.2.1]
bool covers_texel(vec3 centre_ws, vec3 n_ws, vec3 u_ws, vec3 t_ws, vec3 axes, ivec2 texel) {
    vec2 middle_px = (vec2(texel) + 0.5) * float(divisor);
    vec3 origin = pixel_ray_origin(middle_px), direction = pixel_ray_direction(middle_px);
    vec2 depths = texelFetch(surfaces, texel, 0).xy;
#ifdef LOW_RESOLUTION
    if (!covers(centre_ws, n_ws, u_ws, t_ws, axes, origin, direction, depths.y)) return false;
#endif
    return covers(centre_ws, n_ws, u_ws, t_ws, axes, origin, direction, depths.x);
}
