// trace(x, ω) along ω = ±v of a map. [Aalund15 §3.1] Include passes/ldm/frames.glsl and
// passes/ldm/storage.glsl first.
//
// The paper looks for x's own entry in the sequence at x's texel; the entry next to it is the first hit.
// It is silent about two things. A surface is rasterised at the texel's centre, so that its entry is not at
// x's own depth, and where the surface ends before the centre there is no entry at all.
// DEVIATION [Aalund15 §3.1]: x's tangent plane, evaluated at the centre, says where x's own entry must be;
// the first entry beyond it, with a tolerance, is the hit. Where nothing is hit and no own entry is found, the
// ray through the centre starts on the wrong side of an edge, and the nearest other texels are asked.

struct LdmRule {
    float quanta;       // tolerance: constant part, in quanta of depth,
    float slope;        // and part that grows with the slope, in texels
    float offset;       // normal offset: how far x is moved, in texels
    bool other_texels;  // whether nearby texels are asked where no own entry is found
};

struct LdmHit {
    bool found;
    float distance;  // in quanta, along ω
    bool outside;    // x is outside the map: open
    bool own;        // x's own entry was found
    int rejected;    // entries ahead of the tangent plane, by more than rounding, that were taken for x's own
};

/// Least |n·v| that slopes are computed with: they become infinite where a surface is seen edge on.
const float LDM_LEAST_FACING = 0.02;

/// Most that the slope may add to the tolerance, in texels, so that grazing rays see walls of two texels.
const float LDM_MOST_TOLERANCE = 1.5;

/// |n·v| below which a ray grazes the surface.
const float LDM_GRAZING = 0.08;

vec3 ldm_project(MapFrame frame, vec3 position_ws) {
    return vec3(dot(position_ws, frame.u.xyz) + frame.u.w, dot(position_ws, frame.v.xyz) + frame.v.w,
                dot(position_ws, frame.depth.xyz) + frame.depth.w);
}

bool ldm_is_outside(ivec2 texel, int resolution) {
    return any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(resolution)));
}

int ldm_quantum(float depth) {
    return int(clamp(depth, -500000.0, 500000.0));
}

/// One texel's answer; `plane` is the depth of the tangent plane at its centre. With `any_hit` the distance is
/// that of any hit, and `own` is only known where nothing is hit.
LdmHit ldm_ask(uint map, ivec2 texel, int resolution, float plane, float tolerance, bool forward, float reach,
               bool any_hit) {
    int low = ldm_quantum(ceil(plane - tolerance)), high = ldm_quantum(floor(plane + tolerance));
    int key = forward ? high + 1 : low;
    LdmNeighbours near = any_hit ? ldm_any(map, texel, resolution, key, forward)
                                 : ldm_neighbours(map, texel, resolution, key);
    LdmHit hit = LdmHit(false, 0.0, false, false, 0);
    hit.own = forward ? near.before >= low : near.behind <= high;
    hit.distance = forward ? float(near.behind) - plane : plane - float(near.before);
    hit.found = (forward ? near.behind != LDM_NONE_BEHIND : near.before != LDM_NONE_BEFORE) &&
                hit.distance < reach;
#ifdef LDM_VIEWS
    near = ldm_neighbours(map, texel, resolution, key);
    hit.own = forward ? near.before >= low : near.behind <= high;
    hit.rejected = (forward ? float(near.before) > plane + 1.5 : float(near.behind) < plane - 1.5) && hit.own
                       ? 1 : 0;
#endif
    return hit;
}

/// Self-hit rule "tangent-plane". `forward`: ω = v, else -v; n·ω > 0. Hits at `reach` quanta and beyond do not
/// count; where it is infinite, the distance is that of any hit.
LdmHit ldm_trace_tangent(MapFrame frame, uint map, int resolution, vec3 position_ws, vec3 normal_ws,
                         bool forward, float reach, LdmRule rule) {
    vec3 p = ldm_project(frame, position_ws);
    ivec2 texel = ivec2(floor(p.xy));
    if (ldm_is_outside(texel, resolution)) return LdmHit(false, 0.0, true, false, 0);
    float facing = max(abs(dot(normal_ws, frame.direction.xyz)), LDM_LEAST_FACING) * (forward ? 1.0 : -1.0);
    vec2 slope = vec2(dot(normal_ws, frame.step_u.xyz), dot(normal_ws, frame.step_v.xyz)) /
                 (-facing * frame.direction.w);
    float texel_size = max(length(frame.step_u.xyz), length(frame.step_v.xyz));
    float tolerance = rule.quanta + min(rule.slope * (abs(slope.x) + abs(slope.y)),
                                        LDM_MOST_TOLERANCE * texel_size / frame.direction.w);
    vec2 to_centre = vec2(texel) + 0.5 - p.xy;
    LdmHit hit = ldm_ask(map, texel, resolution, p.z + dot(slope, to_centre), tolerance, forward, reach,
                         isinf(reach));
    // A ray that grazes the surface meets the tangent plane more than a texel away when it is moved to a texel's
    // centre, perhaps behind a wall: it is only open if all texels around x say so.
    bool grazing = abs(facing) < LDM_GRAZING;
    if (hit.found || (hit.own && !grazing) || !rule.other_texels) return hit;
    // The three other texels whose centres surround x, nearest first.
    ivec2 side = ivec2(to_centre.x > 0.0 ? -1 : 1, to_centre.y > 0.0 ? -1 : 1);
    bool along_u = abs(to_centre.x) > abs(to_centre.y);
    for (int i = 0; i < 3; ++i) {
        bvec2 moved = i == 2 ? bvec2(true) : i == 0 ? bvec2(along_u, !along_u) : bvec2(!along_u, along_u);
        ivec2 other = texel + side * ivec2(moved);
        if (ldm_is_outside(other, resolution)) continue;
        LdmHit second = ldm_ask(map, other, resolution, p.z + dot(slope, vec2(other) + 0.5 - p.xy), tolerance,
                                forward, reach, false);
        if (second.found ? second.own || grazing : second.own && !grazing) return second;
    }
    return hit;
}

/// Self-hit rule "normal-offset": x is moved along n by offset · sin∠(n, v), the entry nearest to it is taken
/// for its own, and the next one is the hit.
LdmHit ldm_trace_offset(MapFrame frame, uint map, int resolution, vec3 position_ws, vec3 normal_ws,
                        bool forward, float reach, LdmRule rule) {
    float cosine = dot(normal_ws, frame.direction.xyz);
    float texel_size = max(length(frame.step_u.xyz), length(frame.step_v.xyz));
    float distance_ws = rule.offset * texel_size * sqrt(max(0.0, 1.0 - cosine * cosine));
    vec3 p = ldm_project(frame, position_ws + distance_ws * normal_ws);
    ivec2 texel = ivec2(floor(p.xy));
    if (ldm_is_outside(texel, resolution)) return LdmHit(false, 0.0, true, false, 0);
    LdmNeighbours near = ldm_neighbours(map, texel, resolution, ldm_quantum(ceil(p.z)));
    bool before_is_own = p.z - float(near.before) < float(near.behind) - p.z;
    int own = before_is_own ? near.before : near.behind;
    LdmHit hit = LdmHit(false, 0.0, false, false, 0);
    hit.own = own != LDM_NONE_BEFORE && own != LDM_NONE_BEHIND;
    if (!hit.own) return hit;
#ifdef LDM_VIEWS
    hit.rejected = (forward ? float(own) > p.z + 1.5 : float(own) < p.z - 1.5) ? 1 : 0;
#endif
    if (forward && before_is_own) {
        hit.found = near.behind != LDM_NONE_BEHIND;
        hit.distance = float(near.behind - own);
    } else if (!forward && !before_is_own) {
        hit.found = near.before != LDM_NONE_BEFORE;
        hit.distance = float(own - near.before);
    } else {
        near = ldm_neighbours(map, texel, resolution, forward ? own + 1 : own);
        hit.found = forward ? near.behind != LDM_NONE_BEHIND : near.before != LDM_NONE_BEFORE;
        hit.distance = forward ? float(near.behind - own) : float(own - near.before);
    }
    hit.found = hit.found && hit.distance < reach;
    return hit;
}
