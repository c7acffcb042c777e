// trace(x, ω) along ω = ±v of a map. [Aalund15 §3.1] Include passes/ldm/frames.glsl and
// passes/ldm/storage.glsl first.
//
// The paper looks for x's own entry in the sequence at x's texel; the entry next to it is the first hit.
// It is silent about what follows from a surface being rasterised at the texel's centre: its entry is not at
// x's own depth, and where the surface ends before the centre there is no entry at all.
// DEVIATION [Aalund15 §3.1]: x's tangent plane says where a ray through the centre leaves x's surface; the
// first entry beyond that, with a tolerance, and not before x, is the hit. A ray that would run below the
// surface for more than `max_dip` texels starts on the other side of x instead, above the surface.
// Measured at 128 maps of 200² and 3 m on Sponza: RMSE against exact rays 0.0235 away from edges, and no
// leak through closed walls of two texels; querying nearby texels instead where no own entry was found, 0.0245,
// leaks of 7e-5, and 2.7 times the time.

struct LdmRule {
    float quanta;       // tolerance: constant part, in quanta of depth,
    float slope;        // and part that grows with the slope, in texels
    float offset;       // normal offset: how far x is moved, in texels
    float max_dip;  // depth that a ray may run below the surface, in texels
};

struct LdmHit {
    bool found;
    float distance;  // in quanta, along ω
    bool outside;    // x is outside the map: open
    bool own;        // x's own entry was found (known with LDM_VIEWS)
    int rejected;    // entries ahead of the tangent plane, by more than rounding, that were taken for x's own
    ivec2 texel;     // that was queried
    float entry;     // depth of the hit at its centre, in quanta
};

LdmHit ldm_no_hit(bool outside) { return LdmHit(false, 0.0, outside, false, 0, ivec2(0), 0.0); }

/// Least |n·v| that slopes are computed with: they become infinite where a surface is seen edge on.
// C++: ir::passes::ldm::min_facing
const float LDM_MIN_FACING = 0.02;

/// Most that the slope may add to the tolerance, in texels, so that grazing rays see walls of two texels.
// C++: ir::passes::ldm::max_tolerance
const float LDM_MAX_TOLERANCE = 1.5;

/// Quanta by which a storage may move entries; tolerances are no less.
#ifndef LDM_ROUNDING
#define LDM_ROUNDING 0.0
#endif

vec3 ldm_project(MapFrame frame, vec3 position_ws) {
    return vec3(dot(position_ws, frame.u.xyz) + frame.u.w, dot(position_ws, frame.v.xyz) + frame.v.w,
                dot(position_ws, frame.depth.xyz) + frame.depth.w);
}

bool ldm_is_outside(ivec2 texel, int resolution) {
    return any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(resolution)));
}

/// All depths lie well within; beyond it stand LDM_NONE_….
// C++: ir::passes::ldm::*
const float LDM_MAX_KEY = 500000.0;

int ldm_quantum(float depth) {
    return int(clamp(depth, -LDM_MAX_KEY, LDM_MAX_KEY));
}

/// Entries from here on are hits along v, those below it along -v.
int ldm_key(float start, bool forward) {
    return forward ? ldm_quantum(floor(start)) + 1 : ldm_quantum(ceil(start));
}

/// One texel's answer; `plane` is the depth of the tangent plane at its centre, `start` the depth beyond which
/// entries are hits. With `any_hit` the distance is that of any hit.
LdmHit ldm_query(uint map, ivec2 texel, int resolution, float plane, float tolerance, float start, bool forward,
               float reach, bool any_hit) {
    int key = ldm_key(start, forward);
    LdmNeighbours near = any_hit ? ldm_any(map, texel, resolution, key, forward)
                                 : ldm_neighbours(map, texel, resolution, key);
    LdmHit hit = ldm_no_hit(false);
    hit.texel = texel;
    hit.entry = float(forward ? near.behind : near.before);
    hit.distance = forward ? hit.entry - plane : plane - hit.entry;
    hit.found = (forward ? near.behind != LDM_NONE_BEHIND : near.before != LDM_NONE_BEFORE) &&
                hit.distance < reach;
#ifdef LDM_VIEWS
    near = ldm_neighbours(map, texel, resolution, key);
    hit.own = forward ? float(near.before) >= plane - tolerance : float(near.behind) <= plane + tolerance;
    const float near_plane = max(1.5, LDM_ROUNDING);
    hit.rejected = (forward ? float(near.before) > plane + near_plane : float(near.behind) < plane - near_plane) && hit.own
                       ? 1 : 0;
#endif
    return hit;
}

/// What is looked for in a map at a point.
struct LdmQuestion {
    ivec2 texel;
    bool outside;     // of the map: open
    float plane;      // depth from which distances count: of x's tangent plane at the texel's centre, or of x,
                      // moved along its normal
    float tolerance;  // entries this near to the plane are x's own (tangent-plane)
    float start;      // depth beyond which entries are hits (tangent-plane)
    vec2 slope;       // quanta per texel that the tangent plane gains along ω (tangent-plane)
    vec2 to_centre;   // texels from x to the texel's centre
    float depth;      // of x
};

/// Self-hit rule "tangent-plane". `forward`: ω = v, else -v; n·ω > 0.
LdmQuestion ldm_question_tangent(MapFrame frame, int resolution, vec3 position_ws, vec3 normal_ws, bool forward,
                                 LdmRule rule) {
    vec3 p = ldm_project(frame, position_ws);
    ivec2 texel = ivec2(floor(p.xy));
    if (ldm_is_outside(texel, resolution)) return LdmQuestion(texel, true, p.z, 0.0, p.z, vec2(0.0), vec2(0.0), p.z);
    float facing = max(abs(dot(normal_ws, frame.direction.xyz)), LDM_MIN_FACING);
    // Depth along ω that the tangent plane gains per texel.
    vec2 slope = vec2(dot(normal_ws, frame.step_u.xyz), dot(normal_ws, frame.step_v.xyz)) /
                 (-facing * frame.direction.w);
    vec2 to_centre = vec2(texel) + 0.5 - p.xy;
    float gain = dot(slope, to_centre);
    float texel_quanta = ldm_texel_quanta(frame);
    // Moved to the centre, the ray starts below the surface where the plane gains depth, and comes up after
    // `gain`, perhaps behind a wall. The centre on the other side of x, along the steeper axis, starts above it.
    if (gain > rule.max_dip * texel_quanta) {
        bool along_u = abs(slope.x) > abs(slope.y);
        ivec2 back = along_u ? ivec2(slope.x > 0.0 ? -1 : 1, 0) : ivec2(0, slope.y > 0.0 ? -1 : 1);
        if (!ldm_is_outside(texel + back, resolution)) {
            texel += back;
            to_centre += vec2(back);
            gain = dot(slope, to_centre);
        }
    }
    float tolerance =
        rule.quanta + min(rule.slope * (abs(slope.x) + abs(slope.y)), LDM_MAX_TOLERANCE * texel_quanta);
    tolerance = max(tolerance, LDM_ROUNDING);
    float start = max(gain + tolerance, 0.0), along = forward ? 1.0 : -1.0;
    return LdmQuestion(texel, false, p.z + along * gain, tolerance, p.z + along * start, slope, to_centre, p.z);
}

/// Self-hit rule "normal-offset": x is moved along n by offset · sin∠(n, v).
LdmQuestion ldm_question_offset(MapFrame frame, int resolution, vec3 position_ws, vec3 normal_ws, LdmRule rule) {
    float cosine = dot(normal_ws, frame.direction.xyz);
    float texel_size = max(length(frame.step_u.xyz), length(frame.step_v.xyz));
    float distance_ws = rule.offset * texel_size * sqrt(max(0.0, 1.0 - cosine * cosine));
    vec3 p = ldm_project(frame, position_ws + distance_ws * normal_ws);
    ivec2 texel = ivec2(floor(p.xy));
    return LdmQuestion(texel, ldm_is_outside(texel, resolution), p.z, 0.0, p.z, vec2(0.0), vec2(0.0), p.z);
}

#ifdef LDM_SLOPES
LdmSlopeTest ldm_slope_test(MapFrame frame, LdmQuestion q, bool forward, LdmRule rule) {
    float texel_quanta = ldm_texel_quanta(frame);
    float tolerance =
        max(rule.quanta, LDM_ROUNDING) + ldm_slope_tolerance(q.slope, q.to_centre, texel_quanta);
    return LdmSlopeTest(-q.to_centre, q.depth, tolerance, texel_quanta, ldm_key(q.start, forward), forward);
}

/// The answer of nodes with slopes: a hit must lie before x by its depth at the texel's centre, and by its slopes.
LdmHit ldm_query_slopes(MapFrame frame, uint map, int resolution, LdmQuestion q, bool forward, float reach,
                      LdmRule rule) {
    LdmHit hit = ldm_no_hit(false);
#ifdef LDM_VIEWS
    hit = ldm_query(map, q.texel, resolution, q.plane, q.tolerance, q.start, forward, reach, false);
#endif
    int found = ldm_next_by_slopes(map, q.texel, resolution, ldm_slope_test(frame, q, forward, rule));
#ifdef LDM_VIEWS
    if (float(found) != hit.entry) {
        hit.own = true;
        hit.rejected = 1;
    }
#endif
    hit.texel = q.texel;
    hit.entry = float(found);
    hit.distance = forward ? hit.entry - q.plane : q.plane - hit.entry;
    hit.found = found != LDM_NONE_BEHIND && found != LDM_NONE_BEFORE && hit.distance < reach;
    return hit;
}
#endif

/// The answer by rule "tangent-plane". Hits at `reach` quanta and beyond do not count; where it is infinite,
/// the distance is that of any hit.
LdmHit ldm_trace_tangent(MapFrame frame, uint map, int resolution, vec3 position_ws, vec3 normal_ws,
                         bool forward, float reach, LdmRule rule) {
    LdmQuestion q = ldm_question_tangent(frame, resolution, position_ws, normal_ws, forward, rule);
    if (q.outside) return ldm_no_hit(true);
#ifdef LDM_SLOPES
    return ldm_query_slopes(frame, map, resolution, q, forward, reach, rule);
#else
    return ldm_query(map, q.texel, resolution, q.plane, q.tolerance, q.start, forward, reach, isinf(reach));
#endif
}

/// The answer by rule "normal-offset": the entry nearest to x, once moved, is taken for its own, and the next
/// one is the hit.
LdmHit ldm_trace_offset(MapFrame frame, uint map, int resolution, vec3 position_ws, vec3 normal_ws,
                        bool forward, float reach, LdmRule rule) {
    LdmQuestion q = ldm_question_offset(frame, resolution, position_ws, normal_ws, rule);
    if (q.outside) return ldm_no_hit(true);
    LdmNeighbours near = ldm_neighbours(map, q.texel, resolution, ldm_quantum(ceil(q.plane)));
    bool before_is_own = q.plane - float(near.before) < float(near.behind) - q.plane;
    int own = before_is_own ? near.before : near.behind;
    LdmHit hit = ldm_no_hit(false);
    hit.texel = q.texel;
    hit.own = own != LDM_NONE_BEFORE && own != LDM_NONE_BEHIND;
    if (!hit.own) return hit;
#ifdef LDM_VIEWS
    const float near_plane = max(1.5, LDM_ROUNDING);
    hit.rejected = (forward ? float(own) > q.plane + near_plane : float(own) < q.plane - near_plane) ? 1 : 0;
#endif
    if (forward != before_is_own) near = ldm_neighbours(map, q.texel, resolution, forward ? own + 1 : own);
    hit.found = forward ? near.behind != LDM_NONE_BEHIND : near.before != LDM_NONE_BEFORE;
    hit.entry = float(forward ? near.behind : near.before);
    hit.distance = abs(hit.entry - float(own));
    hit.found = hit.found && hit.distance < reach;
    return hit;
}

/// The answer without a self-hit rule: hits count from `beyond` quanta on, where nothing can be x's own.
/// `tangent`: at the texel and from the plane that the rule "tangent-plane" queries, else "normal-offset".
LdmHit ldm_trace_beyond(MapFrame frame, uint map, int resolution, vec3 position_ws, vec3 normal_ws, bool forward,
                        float reach, LdmRule rule, float beyond, bool tangent) {
    LdmQuestion q = tangent ? ldm_question_tangent(frame, resolution, position_ws, normal_ws, forward, rule)
                            : ldm_question_offset(frame, resolution, position_ws, normal_ws, rule);
    if (q.outside) return ldm_no_hit(true);
    float start = q.plane + (forward ? beyond : -beyond);
    return ldm_query(map, q.texel, resolution, q.plane, 0.0, start, forward, reach, isinf(reach));
}
