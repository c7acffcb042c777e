// The surface about a map's entry, from the entries of neighbouring texels: entries are exact at the centres of
// their texels, and know nothing of the surface between them. Include passes/ldm/trace.glsl first.
// On the host: ir::passes::ldm::PointTracer.

/// Depth that neighbouring entries of one surface may differ by, in sides of a texel. Photons on steeper planes have
/// footprints so long that they light what lies before and behind: with 8, `veach-ajar` has 1.29 of its indirect light
/// instead of 1.20.
// C++: ir::passes::ldm::steepest_texels
const float LDM_STEEPEST = 3.0;

/// A texel's nearest entry to a depth, in quanta; false where there is none within `reach`.
bool ldm_nearest(uint map, ivec2 texel, int resolution, float depth, float reach, out float entry) {
    entry = 0.0;
    if (ldm_is_outside(texel, resolution)) return false;
    LdmNeighbours near = ldm_neighbours(map, texel, resolution, ldm_quantum(ceil(depth)));
    float before = depth - float(near.before), behind = float(near.behind) - depth;
    entry = float(before < behind ? near.before : near.behind);
    return min(before, behind) <= reach;
}

/// depth(texel + δ) = entry + slope·δ
struct LdmPlane {
    vec2 slope;  // quanta per texel
    bool known;
};

/// Of two neighbours along an axis the one behind which the surface goes on straight gives the slope.
bool ldm_slope(uint map, ivec2 texel, int resolution, ivec2 axis, float entry, float steepest, out float slope) {
    float least = 2.0 * steepest;
    bool known = false;
    slope = 0.0;
    for (int side = -1; side <= 1; side += 2) {
        float next, second, bend = steepest;
        if (!ldm_nearest(map, texel + side * axis, resolution, entry, steepest, next)) continue;
        if (ldm_nearest(map, texel + 2 * side * axis, resolution, 2.0 * next - entry, steepest, second))
            bend = abs(second - 2.0 * next + entry);
        if (bend < least) {
            least = bend;
            slope = float(side) * (next - entry);
            known = true;
        }
    }
    return known;
}

LdmPlane ldm_plane(MapFrame frame, uint map, ivec2 texel, int resolution, float entry) {
    float steepest = LDM_STEEPEST * ldm_texel_quanta(frame);
    LdmPlane plane;
    bool known_u = ldm_slope(map, texel, resolution, ivec2(1, 0), entry, steepest, plane.slope.x);
    bool known_v = ldm_slope(map, texel, resolution, ivec2(0, 1), entry, steepest, plane.slope.y);
    plane.known = known_u && known_v;
    return plane;
}

/// Unit, against the direction of travel.
vec3 ldm_normal(MapFrame frame, LdmPlane plane, vec3 direction) {
    vec3 along = frame.direction.w * frame.direction.xyz;
    vec3 n = normalize(cross(frame.step_u.xyz + plane.slope.x * along, frame.step_v.xyz + plane.slope.y * along));
    return dot(n, direction) < 0.0 ? n : -n;
}

/// Of a plane with normal n, as LdmPlane::slope.
vec2 ldm_slope_of(MapFrame frame, vec3 n) {
    float facing = dot(n, frame.direction.xyz);
    facing = facing < 0.0 ? min(facing, -LDM_MIN_FACING) : max(facing, LDM_MIN_FACING);
    return vec2(dot(n, frame.step_u.xyz), dot(n, frame.step_v.xyz)) / (-facing * frame.direction.w);
}
