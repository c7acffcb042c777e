// trace(x, ω) by the self-hit rule that the parameters choose (ir::passes::ldm::self_hit_parameters). For programs
// of methods, after passes/ldm/trace.glsl.

LdmRule ldm_rule() {
#ifdef LDM_SLOPES
    const float part = LDM_SLOPED_TOLERANCE;
#else
    const float part = 1.0;
#endif
    return LdmRule(params.self_hit_tolerance, part * params.slope_tolerance, params.normal_offset, params.max_dip);
}

/// First hit from x along ω = v (`forward`) or -v of a map, nearer than `reach` quanta; `map` counts from the
/// batch's first. `normal_ws` is geometric, unit length, and n·ω > 0. With an infinite reach any hit answers, and
/// the distance is not that of the first: use LDM_FAR_QUANTA where it matters.
LdmHit ldm_trace(MapFrame frame, uint map, vec3 position_ws, vec3 normal_ws, bool forward, float reach) {
    return params.self_hit == SELF_HIT_TANGENT_PLANE
               ? ldm_trace_tangent(frame, map, params.resolution, position_ws, normal_ws, forward, reach, ldm_rule())
               : ldm_trace_offset(frame, map, params.resolution, position_ws, normal_ws, forward, reach, ldm_rule());
}

/// Beyond any depth, but finite.
const float LDM_FAR_QUANTA = 1e7;
