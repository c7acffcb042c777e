// Emission sets: low-discrepancy points of the unit square, one set for each source, and their warping.

#include "lib/random.glsl"

struct EmissionSet {
    uint points;   // of the source in a frame
    uint stratum;  // which of the cycle's disjoint sets
    uint strata;
    vec2 shift;    // of the whole set around the torus, by the frame's seed
};

const uint EMISSION_SHIFT = 0x9e3779b9u;     // purposes of random numbers
const uint EMISSION_ROULETTE = 0x85ebca6bu;

vec2 emission_shift(uint source, uvec2 seed) {
    return unit_float(pcg4d(uvec4(source, seed, EMISSION_SHIFT)).xy);
}

/// Point `i` of a Hammersley set of `points`: i / n and the radical inverse of i. A cycle's sets go on in the
/// radical inverse and lie between each other in the other coordinate: disjoint, and together one set again.
/// [Hammersley60; Cranley76, for the shift]
vec2 emission_point(EmissionSet set, uint i) {
    vec2 point = vec2((float(i) + (float(set.stratum) + 0.5) / float(set.strata)) / float(set.points),
                      unit_float(bitfieldReverse(set.stratum * set.points + i)));
    return min(fract(point + set.shift), vec2(0.99999994));
}

/// A point on its way through the levels: a cell of 2^levels a side, and where in it.
struct WarpedPoint {
    uvec2 cell;
    vec2 within;  // [0, 1)²
};

/// To one of two halves in proportion to what they hold, and stretched over it.
float warped_coordinate(float u, float first, float second, out uint half_index) {
    float sum = first + second;
    float share = sum > 0.0 ? first / sum : 0.5;
    half_index = u < share ? 0u : 1u;
    float rest = u < share ? u / share : (u - share) / (1.0 - share);
    return min(rest, 0.99999994);
}

/// `quad`: what the quarters of the point's cell hold, upper left, upper right, lower left, lower right.
/// First horizontally.  [Clarberg05 §4; Smal19 fig. 5.6]
WarpedPoint warped_horizontally(WarpedPoint p, vec4 quad) {
    uint right;
    p.within.x = warped_coordinate(p.within.x, quad.x + quad.z, quad.y + quad.w, right);
    p.cell.x = 2u * p.cell.x + right;
    return p;
}

/// Then vertically, in the half that it is in now.
WarpedPoint warped_vertically(WarpedPoint p, vec4 quad) {
    uint lower;
    bool is_right = (p.cell.x & 1u) != 0u;
    p.within.y = warped_coordinate(p.within.y, is_right ? quad.y : quad.x, is_right ? quad.w : quad.z, lower);
    p.cell.y = 2u * p.cell.y + lower;
    return p;
}
