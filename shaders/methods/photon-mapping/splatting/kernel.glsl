// The kernel that a photon is spread over, one function a formula; u, t and n are its half-axes.
// Lengths in m, areas in m², power in W.

#include "lib/constants.glsl"
#include "lib/spaces.glsl"

/// s_l. DEVIATION [Smal19 eq. 6.1]: the print has no lower bound, so that E grows without limit as l falls to
/// 0; the listing of appendix C has this one, 0.1.
float ray_length_scale(float ray_length, float largest_length, float least) {
    return clamp(ray_length / largest_length, least, 1.0);
}

/// a_view: what the camera sees of a tile, faced at this depth. c_tile is the tile's share of the picture
/// times 4 tan(α_x/2) tan(α_y/2), or of the height times the width of a parallel view.
/// DEVIATION [Smal19 §6.1.1]: the print lacks the 4, with which the frustum's half-extents z tan(α/2) become
/// extents: its radii are half as long.
float tile_area(float depth, float c_tile, bool perspective) {
    return perspective ? depth * depth * c_tile : c_tile;
}

/// Surfaces that are seen more edge-on than this cosine are taken for no larger.
// C++: ir::methods::photon_mapping::least_facing
const float LEAST_FACING = 0.1;

/// Of what is seen as this area, faced: `facing` is n·d with d to the eye, 1 long along the view axis.
/// DEVIATION [Smal19 §6.1.1]: the print takes surfaces for faced, so that of n_tile photons a kernel on a slanted one
/// holds n_tile times the cosine, and leaves noise in streaks. The bound is for the longest kernels.
float surface_area(float area, float facing) { return area / max(facing, LEAST_FACING); }

/// r: of a disc with a photon's share of the tile's surface.  [Smal19 §6.1.1]
float density_radius(float area, float photons_in_tile) {
    return sqrt(area / (PI * photons_in_tile));
}

/// s_d for n_tile photons in a kernel. DEVIATION [Smal19 eq. 6.2]: the print multiplies by n_tile itself, with
/// which n_tile² photons fall into a kernel.
float density_scale(float radius, float least, float largest, float n_tile) {
    return clamp(radius, least, largest) * sqrt(n_tile);
}

/// s_u, of the cosine between normal and direction to the light.  [Smal19 eq. 6.3]
float light_shaping_scale(float n_dot_l, float largest) {
    return n_dot_l * largest > 1.0 ? 1.0 / n_dot_l : largest;
}

/// Unit vector along which the kernel is stretched: the direction to the light, laid into the plane. At normal
/// incidence, where s_u is 1, it is any one there.  [Smal19 §6.1.2]
vec3 stretched_direction(vec3 n, vec3 to_light) {
    vec3 in_plane = to_light - dot(n, to_light) * n;
    float size = length(in_plane);
    return size > 1e-4 ? in_plane / size : frame_around(n)[0];
}

/// A = π ‖u‖ ‖t‖.  [Smal19 §6.2]
float kernel_area(float u, float t) { return PI * u * t; }

/// E of one photon.  [Smal19 eq. 6.6]
vec3 kernel_irradiance(vec3 power, float area) { return power / area; }

/// Of a point in kernel space, where the ellipsoid is the unit sphere. False for what is not a number.
/// [Smal19 eq. 6.5]
bool inside_ellipsoid(vec3 point_ks) { return dot(point_ks, point_ks) <= 1.0; }

/// Depth, along a ray that advances by 1 along the view axis, at which the kernel's plane is met.
float kernel_plane_depth(vec3 to_centre, vec3 n, vec3 ray_direction) {
    return dot(n, to_centre) / dot(n, ray_direction);
}

/// The plane's point lies in the ellipse, and the surface within the kernel's half-thickness of it along the
/// view axis.
/// DEVIATION [Smal19 §6.2, appendix C]: the listing has no ellipse, but all that the icosahedron covers, in the
/// mean over directions 121 % of A where it encloses the kernel and 76 % where its vertices lie on it; and one
/// thickness for all kernels, which is not printed.
bool inside_kernel_plane(vec2 plane_point_ks, float plane_depth, float surface_depth, float half_thickness) {
    return dot(plane_point_ks, plane_point_ks) <= 1.0 && abs(surface_depth - plane_depth) <= half_thickness;
}
