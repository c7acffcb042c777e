// What the previous frame knows of a pixel's surface.

uniform sampler2D gbuffer_velocity;
uniform sampler2D gbuffer_geometric_normal;  // w: depth in the previous frame
uniform sampler2D previous_value;
uniform sampler2D previous_direction;
uniform usampler2D previous_surfaces;

uniform sampler2D previous_length;

uniform float temporal_weight;
uniform bool has_history, warms_up, stands_still;
uniform vec3 previous_origin_dx, previous_origin_dy;
uniform vec3 previous_direction_ws, previous_direction_dx, previous_direction_dy;

struct History {
    float weight;  // α; 0: there is nothing
    float length;  // frames that it is the mean of
    Signal signal;
};

/// α of a mean over frames while there are few.
/// DEVIATION [Smal19 §7.2]: there α is the same from the first frame on, which is then 20 % of the picture after 32
/// frames at a weight of 0.95. Here the first n frames count 1/n each, unless `warm_up` is off.
float warm_weight(float frames) { return warms_up ? min(temporal_weight, frames / (frames + 1.0)) : temporal_weight; }

#ifdef PROGRESSIVE

/// The mean of all frames since something moved.  [Knaus11 §3]
History history_of(ivec2 pixel, FilterSurface p) {
    History history = History(0.0, 0.0, Signal(vec4(0), vec2(0)));
    if (!has_history || !stands_still) return history;
    history.length = texelFetch(previous_length, pixel, 0).x;
    history.weight = history.length / (history.length + 1.0);
    history.signal = Signal(texelFetch(previous_value, pixel, 0), texelFetch(previous_direction, pixel, 0).xy);
    return history;
}

#else

/// α = 0.95 w_z w_n  [Smal19 eq. 7.4], for each of the four texels of a bilinear look-up by itself, so that
/// those of other surfaces stay out.
/// DEVIATION [Smal19 §7.2]: a texel's depth is compared with that of the pixel's plane there, in the previous
/// camera, and the tolerance is the gradient over one pixel, whatever the motion: with |p - q| of the print
/// still pictures would accept rounding alone and fast ones would accept anything.
History history_of(ivec2 pixel, FilterSurface p) {
    History history = History(0.0, 0.0, Signal(vec4(0), vec2(0)));
    float z = texelFetch(gbuffer_geometric_normal, pixel, 0).w;
    if (!has_history || z <= 0.0) return history;
    vec2 q = vec2(pixel) + 0.5 - texelFetch(gbuffer_velocity, pixel, 0).xy;
    vec2 gradient = depth_gradient(p.normal, z, previous_direction_ws + q.x * previous_direction_dx +
                                                    q.y * previous_direction_dy,
                                   previous_origin_dx, previous_origin_dy, previous_direction_dx,
                                   previous_direction_dy);
    // Rounded to 1/256, as texture filters do it, so that a velocity's rounding does not blur what stands.
    vec2 place = round((q - 0.5) * 256.0) / 256.0;
    vec2 base = floor(place), f = place - base;
    ivec2 size = textureSize(previous_surfaces, 0);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec2 share = mix(1.0 - f, f, vec2(corner));
        ivec2 texel = ivec2(clamp(base, vec2(-2), vec2(size))) + corner;
        if (share.x * share.y == 0.0 || any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size)))
            continue;
        FilterSurface s = unpacked_surface(texelFetch(previous_surfaces, texel, 0).xy);
        if (!is_surface(s)) continue;
        float plane_depth = z + dot(gradient, vec2(texel) + 0.5 - q);
        float w = share.x * share.y * depth_weight(s.depth - plane_depth, length(gradient), z) *
                  normal_weight(p.normal, s.normal);
        history.signal.value += w * texelFetch(previous_value, texel, 0);
        history.signal.direction += w * texelFetch(previous_direction, texel, 0).xy;
        history.length += w * texelFetch(previous_length, texel, 0).x;
        history.weight += w;
    }
    if (history.weight <= 0.0) return history;
    history.signal.value /= history.weight;
    history.signal.direction /= history.weight;
    history.weight *= warm_weight(history.length / history.weight);
    return history;
}

#endif
