// Whether a kernel covers a texel: the same arithmetic for the splat, for gathering, and for the gather that explains.
#include "methods/photon-mapping/splatting/depths.glsl"

#ifdef FACING
uniform sampler2D gbuffer_geometric_normal;
#endif

/// What a texel shows, along the ray through its pixel.
struct SeenSurface {
    vec3 origin, direction;
    float depth;
    vec3 normal;  // where kernels test it
};

SeenSurface surface_seen_at(ivec2 texel) {
    vec2 middle_px = pixel_at(texel);
    SeenSurface seen;
    seen.origin = pixel_ray_origin(middle_px);
    seen.direction = pixel_ray_direction(middle_px);
    seen.depth = texelFetch(depths, texel, 0).x;
#ifdef FACING
    seen.normal = texelFetch(gbuffer_geometric_normal, divisor * texel + pixel_of_texel, 0).xyz;
#endif
    return seen;
}

bool covers(vec3 centre_ws, vec3 n_ws, vec3 u_ws, vec3 t_ws, vec3 axes, vec3 to_light_ws, SeenSurface seen) {
#ifdef FACING
    if (dot(seen.normal, to_light_ws) <= 0.0) return false;
#endif
#ifdef LINEAR_DEPTH
    vec3 to_centre = centre_ws - seen.origin;
    float plane_depth = kernel_plane_depth(to_centre, n_ws, seen.direction);
    vec3 offset = plane_depth * seen.direction - to_centre;
    return inside_kernel_plane(vec2(dot(u_ws, offset), dot(t_ws, offset)) / axes.xy, plane_depth, seen.depth, axes.z);
#else
    vec3 offset = seen.origin + seen.depth * seen.direction - centre_ws;
    return inside_ellipsoid(vec3(dot(u_ws, offset), dot(t_ws, offset), dot(n_ws, offset)) / axes);
#endif
}

bool covers_texel(vec3 centre_ws, vec3 n_ws, vec3 u_ws, vec3 t_ws, vec3 axes, vec3 to_light_ws, ivec2 texel) {
    return covers(centre_ws, n_ws, u_ws, t_ws, axes, to_light_ws, surface_seen_at(texel));
}
