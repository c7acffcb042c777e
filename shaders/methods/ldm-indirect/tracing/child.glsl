// The record of a photon behind the first surface. Include passes/ldm/frames.glsl, lib/spaces.glsl, records.glsl,
// tracing/differentials.glsl and primary.glsl before.

/// It flew a way of t m along the direction of a map that the first surface sends light to. `map` counts among all.
Photon photon_of(Primary p, uint map, float t, uint packed_normal) {
    vec3 v = ldm_frames[map].direction.xyz, normal = unpacked_direction(packed_normal);
    float cosine = dot(p.shading_ws, v);
    vec3 direction = cosine > 0.0 ? v : -v;
    Axes axes = Axes(transferred(p.axis_u, rotated(p.turn_u, p.direction_ws, direction), t, direction, normal),
                     transferred(p.axis_v, rotated(p.turn_v, p.direction_ws, direction), t, direction, normal));
    if (params.footprint == FOOTPRINT_WIDENED)
        axes = widened(axes, direction, normal, t, sqrt(2.0 / float(params.directions)));
    Photon result;
    result.centre_ws = p.position_ws + t * direction;
    result.source = p.source;
    result.axis_u = axes.u;
    result.axis_v = axes.v;
    result.leg = map | (cosine > 0.0 ? LEG_ALONG : 0u) | p.light << LEG_LIGHT_SHIFT;
    result.path_length = p.path_length + t;
    result.distance = t;
    result.unused0 = result.unused1 = result.unused2 = 0.0;
    result.flux = reflected_flux(p) * (abs(cosine) / p.cosine_sum);
    result.normal = packed_normal;
    return result;
}
