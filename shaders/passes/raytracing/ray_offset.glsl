/// Smallest and relative distance by which rays start away from their surface. The relative part is 32 units in the
/// last place (2⁻²³ each) of the largest coordinate: rasterised positions of Sponza were measured 1 to 4 units off
/// their triangle's plane (99 %), seldom 7, and the traversal adds a few of its own.
// C++: ir::passes::*
const float MIN_RAY_OFFSET_M = 1e-6, RELATIVE_RAY_OFFSET = 3.814697265625e-6;

/// Shadow rays end at this fraction of the way to the point on the light, so that they do not meet it.
// C++: ir::passes::shadow_ray_end
const float SHADOW_RAY_END = 0.9999;

/// Panes that a ray passes one behind the other; it starts anew at each.
// C++: ir::passes::max_panes
const int MAX_PANES = 8;

/// How far a ray's origin must be moved so that the ray does not meet the surface that it starts on, in metres at
/// `position_ws`: 4 µm near 1 m, 4 mm near 1 km. After [Waechter19], with a length in place of steps in the integer
/// representation, so that all components move along the normal.
float ray_offset(vec3 position_ws) {
    vec3 size = abs(position_ws);
    return MIN_RAY_OFFSET_M + RELATIVE_RAY_OFFSET * max(size.x, max(size.y, size.z));
}

/// Origin of rays that leave the side to which the unit geometric normal points.
vec3 offset_origin(vec3 position_ws, vec3 geometric_normal_ws) {
    return position_ws + ray_offset(position_ws) * geometric_normal_ws;
}
