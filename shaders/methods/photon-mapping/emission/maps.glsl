// Probability map and Haar pyramid, and the way of a point through them. Before including, choose the texture
// units PROBABILITY_MAP and HAAR_PYRAMID.

#include "methods/photon-mapping/emission/emission_set.glsl"

uniform sampler2DArray probability_map;
uniform sampler2DArray haar_pyramid;

/// Mean of the layer's map.
float mean_probability(int layer, int levels) { return texelFetch(haar_pyramid, ivec3(0, 0, layer), levels - 1).r; }

float scaling_at(uvec2 cell, int layer, int level) {
    return level < 0 ? texelFetch(probability_map, ivec3(cell, layer), 0).r
                     : texelFetch(haar_pyramid, ivec3(cell, layer), level).r;
}

/// Scaling coefficients of the four cells below one of the pyramid's level. They are read, not put together
/// from details, so that empty texels are exactly 0.
vec4 quad_below(uvec2 cell, int layer, int level) {
    uvec2 corner = 2u * cell;
    return vec4(scaling_at(corner, layer, level - 1), scaling_at(corner + uvec2(1, 0), layer, level - 1),
                scaling_at(corner + uvec2(0, 1), layer, level - 1), scaling_at(corner + uvec2(1, 1), layer, level - 1));
}

/// From the whole square to a texel of the map, 2^levels a side.
WarpedPoint warped_to_texel(vec2 point, int layer, int levels) {
    WarpedPoint p = WarpedPoint(uvec2(0), point);
    for (int level = levels - 1; level >= 0; --level) {
        vec4 quad = quad_below(p.cell, layer, level);
        p = warped_vertically(warped_horizontally(p, quad), quad);
    }
    return p;
}

WarpedPoint unwarped_texel(vec2 point, int resolution) {
    vec2 scaled = point * float(resolution);
    uvec2 cell = min(uvec2(scaled), uvec2(resolution - 1));
    return WarpedPoint(cell, min(scaled - vec2(cell), vec2(0.99999994)));
}
