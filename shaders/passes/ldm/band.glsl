// How a map is read for one point, told entry by entry. Include passes/ldm/frames.glsl, passes/ldm/storage.glsl and
// passes/ldm/trace.glsl first.

/// A point's place in the sequence of the texel that is queried: entries from `low` to `high` are its own, the first
/// one above them is the hit along v, the last one below them the hit along -v.
struct LdmBand {
    ivec2 texel;
    bool outside;  // of the map: open
    float plane;   // depth from which distances count
    float low, high;
    int stop;  // a search from the front ends at the first entry that is not below this depth
};

/// `forward`: the direction above the surface is v, else -v.
LdmBand ldm_band_tangent(MapFrame frame, int resolution, vec3 position_ws, vec3 normal_ws, bool forward,
                         LdmRule rule) {
    LdmQuestion q = ldm_question_tangent(frame, resolution, position_ws, normal_ws, forward, rule);
    float low = forward ? q.plane - q.tolerance : q.start, high = forward ? q.start : q.plane + q.tolerance;
    return LdmBand(q.texel, q.outside, q.plane, low, high,
                   forward ? ldm_quantum(floor(q.start)) + 1 : ldm_quantum(ceil(q.start)));
}

/// Where the texel is empty nothing is the point's own and nothing is hit.
LdmBand ldm_band_offset(MapFrame frame, uint map, int resolution, vec3 position_ws, vec3 normal_ws, LdmRule rule) {
    LdmQuestion q = ldm_question_offset(frame, resolution, position_ws, normal_ws, rule);
    int stop = ldm_quantum(ceil(q.plane));
    LdmBand band = LdmBand(q.texel, q.outside, q.plane, q.plane, q.plane, stop);
    if (q.outside) return band;
    LdmNeighbours near = ldm_neighbours(map, q.texel, resolution, stop);
    int own = q.plane - float(near.before) < float(near.behind) - q.plane ? near.before : near.behind;
    if (own == LDM_NONE_BEFORE || own == LDM_NONE_BEHIND) return band;
    band.plane = band.low = band.high = float(own);
    return band;
}

LdmBand ldm_band(bool tangent_plane, MapFrame frame, uint map, int resolution, vec3 position_ws, vec3 normal_ws,
                 bool forward, LdmRule rule) {
    return tangent_plane ? ldm_band_tangent(frame, resolution, position_ws, normal_ws, forward, rule)
                         : ldm_band_offset(frame, map, resolution, position_ws, normal_ws, rule);
}
