// Whether a kernel covers a texel: the same arithmetic for the splat, for gathering, and for the gather that explains.
// FACING: kernels test normals. REFLECTS: texels reflect photons, MATERIALS as Transport::Materials counts.
#include "methods/photon-mapping/splatting/depths.glsl"

#if defined(FACING) || defined(REFLECTS)
uniform sampler2D gbuffer_geometric_normal;
#endif
#ifdef REFLECTS
#include "passes/reflection/receiver.glsl"
#include "passes/reflection/shading_normal.glsl"
#endif

/// What a texel shows, along the ray through its pixel.
struct SeenSurface {
    vec3 origin, direction;
    float depth;
    vec3 normal;  // geometric, where it is asked for
#ifdef REFLECTS
    Receiver receiver;
#endif
};

SeenSurface surface_seen_at(ivec2 texel) {
    vec2 middle_px = pixel_at(texel);
    SeenSurface seen;
    seen.origin = pixel_ray_origin(middle_px);
    seen.direction = pixel_ray_direction(middle_px);
    seen.depth = texelFetch(depths, texel, 0).x;
#if defined(FACING) || defined(REFLECTS)
    ivec2 pixel = divisor * texel + pixel_of_texel;
    seen.normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
#endif
#ifdef REFLECTS
    seen.receiver = receiver_at(pixel, shading_normal(pixel), -normalize(seen.direction));
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
